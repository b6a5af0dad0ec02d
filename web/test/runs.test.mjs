// Opens reports of real runs in Chromium: replays them with clicks and keys, and compares pictures with stored ones.
// Usage: node runs.test.mjs FOLDER_OF_RUNS STORED_PICTURES [FOLDER_FOR_SCREENSHOTS]
// With PROBEWRIGHT_UPDATE_PICTURES=1 the stored pictures are made again: look at them before they are committed.

import assert from "node:assert/strict";
import { existsSync, mkdirSync, readFileSync, statSync, writeFileSync } from "node:fs";
import { join, resolve } from "node:path";
import { test } from "node:test";
import { pathToFileURL } from "node:url";
import { browser, settle, stageIsThere, withoutGraphics } from "./chromium.mjs";
import { scrolled } from "./scrolled.mjs";

const [runs, stored, screenshots] = process.argv.slice(2);
const update = process.env.PROBEWRIGHT_UPDATE_PICTURES === "1";

if (screenshots) mkdirSync(screenshots, { recursive: true });

async function open(run, { width = 1400, height = 900, dark = false, graphics = true } = {}) {
  const page = await browser.newPage();
  const problems = [];
  page.on("pageerror", (error) => problems.push(String(error)));
  page.setDefaultTimeout(120_000);
  page.setDefaultNavigationTimeout(120_000);
  await page.setViewport({ width, height });
  await page.emulateMediaFeatures([{ name: "prefers-color-scheme", value: dark ? "dark" : "light" }]);
  if (!graphics) await withoutGraphics(page);
  await page.goto(pathToFileURL(resolve(runs, run, "report.html")).href);
  await page.waitForSelector(graphics ? ".stage canvas" : ".stage .empty");
  await settle(page);
  return { page, problems };
}

const resultsOf = (run) => JSON.parse(readFileSync(join(runs, run, "results.json"), "utf8"));
const text = (page, selector) => page.$eval(selector, (element) => element.innerText);
const click = (page, label) => page.$$eval(".replay button", (all, wanted) => all.find((button) => button.getAttribute("aria-label").startsWith(wanted)).click(), label);
/** The line of the program that the display names. */
const lineOf = async (page) => Number(/ (\d+)$/.exec(await page.$eval(".display .state dd", (element) => element.textContent))[1]);

test("a replay goes block by block, forward and back, by click and by key", async () => {
  const { page, problems } = await open("housing");
  const lines = [];
  for (let i = 0; i < 12; ++i) {
    await click(page, "Block on");
    lines.push(await lineOf(page));
  }
  // Each block once, in the order in which the program runs; the line that is marked is the one that is shown.
  assert.ok(lines.every((line, i) => i === 0 || line !== lines[i - 1]), lines.join());
  assert.ok(lines.slice(1).filter((line, i) => line > lines[i]).length >= 8, lines.join());
  assert.equal(await page.$eval(".line.running", (line) => Number(line.dataset.line)), lines.at(-1));
  await click(page, "Block back");
  assert.equal(await lineOf(page), lines.at(-2));
  await page.keyboard.press(".");
  assert.equal(await lineOf(page), lines.at(-1));
  await page.keyboard.press(",");
  assert.equal(await lineOf(page), lines.at(-2));
  assert.deepEqual(problems, []);
  await page.close();
});

test("cycles and alarms are marked on the time line, where they were", async () => {
  for (const run of ["housing", "alarm"]) {
    const { page, problems } = await open(run);
    const { cycles, events, run: head } = resultsOf(run);
    const marks = await page.$eval(".marks", (canvas) => {
      const { width, height } = canvas;
      const { data } = canvas.getContext("2d").getImageData(0, 0, width, height);
      const scale = width / canvas.getBoundingClientRect().width;
      const style = getComputedStyle(document.documentElement);
      const probe = document.createElement("canvas").getContext("2d");
      const rgb = (name) => {
        probe.fillStyle = style.getPropertyValue(`--${name}`).trim();
        probe.fillRect(0, 0, 1, 1);
        return [...probe.getImageData(0, 0, 1, 1).data.slice(0, 3)];
      };
      const row = (y) => Array.from({ length: width }, (_, x) => [...data.slice(4 * (Math.round(y * scale) * width + x), 4 * (Math.round(y * scale) * width + x) + 4)]);
      return { width, scale, bar: row(7), top: row(1), free: rgb("none-soft"), alarm: rgb("alarm"), total: Number(document.querySelector(".timeline input").max) };
    });
    const inset = 8 * marks.scale;
    const at = (time) => Math.round(inset + ((marks.width - 2 * inset) * time) / marks.total);
    const is = (pixel, colour) => pixel[3] > 200 && colour.every((value, i) => Math.abs(value - pixel[i]) < 12);
    for (const cycle of cycles.filter(({ start, end }) => at(end) - at(start) > 4))
      assert.ok(!is(marks.bar[at((cycle.start + cycle.end) / 2)], marks.free), `${run}: cycle at ${cycle.start}`);
    const before = cycles[0].start;
    if (at(before) - inset > 4) assert.ok(is(marks.bar[at(before / 2)], marks.free), `${run}: nothing before the first cycle`);
    const alarm = events.find(({ kind }) => kind === "alarm");
    assert.equal(!!alarm, run === "alarm");
    if (alarm) assert.ok(is(marks.top[Math.min(at(alarm.time), marks.width - 2)], marks.alarm), "the alarm's mark");
    assert.ok(head);
    assert.deepEqual(problems, []);
    await page.close();
  }
});

test("the time line is as wide as the picture that it belongs to", async () => {
  for (const width of [1400, 800, 390]) {
    const { page, problems } = await open("housing", { width, height: width === 390 ? 844 : 900 });
    const wide = await page.evaluate(() => {
      const box = (selector) => document.querySelector(selector).getBoundingClientRect();
      const canvas = document.querySelector(".timeline .marks");
      const row = Math.round((7 * canvas.width) / box(".timeline .marks").width);
      const drawn = [...canvas.getContext("2d").getImageData(0, row, canvas.width, 1).data].filter((_, i) => i % 4 === 3).filter((alpha) => alpha > 200).length;
      return { picture: box(".stage").width, line: box(".timeline").width, slider: box(".timeline input").width, drawn: (drawn * box(".timeline .marks").width) / canvas.width, page: document.documentElement.scrollWidth };
    });
    const told = JSON.stringify({ width, ...wide });
    assert.ok(wide.line >= wide.picture - 20, told);
    assert.ok(Math.abs(wide.slider - wide.line) < 1, told);
    assert.ok(wide.drawn >= wide.line - 20, told);
    assert.ok(wide.page <= width, told);
    assert.deepEqual(problems, []);
    await page.close();
  }
});

test("two thousand cycles are a page like any other", async () => {
  assert.ok(statSync(join(runs, "many", "report.html")).size < 10e6);
  const { page, problems } = await open("many");
  assert.match(await text(page, ".facts-line"), /2003 cycles/);
  // Processor time, which other work on the computer does not change: what a frame has at 60 a second.
  const { own, elements } = await scrolled(page, ".sheet", 40);
  assert.ok(elements < 3000, `${elements} elements`);
  assert.ok(own < 16, `${own} ms a frame`);
  // Where it has been scrolled to, there are rows, in their order and without gaps.
  const rows = await page.$$eval(".virtual-row", (all) => all.map((row) => row.getBoundingClientRect()).map(({ top, bottom }) => [top, bottom]).sort((a, b) => a[0] - b[0]));
  const sheet = await page.$eval(".sheet", (list) => list.getBoundingClientRect().toJSON());
  assert.ok(rows[0][0] <= sheet.top + 80 && rows.at(-1)[1] >= sheet.bottom - 1, JSON.stringify([rows[0], rows.at(-1), sheet]));
  rows.slice(1).forEach(([top], i) => assert.ok(Math.abs(top - rows[i][1]) < 1, `${top} after ${rows[i][1]}`));
  assert.deepEqual(problems, []);
  await page.close();
});

test("the clearance is a curve over time, and told where the replay is", async () => {
  const { page, problems } = await open("housing");
  const { truth } = resultsOf("housing");
  const near = truth.clearance.spans.filter(({ orMore }) => !orMore).toSorted((a, b) => a.distance - b.distance)[0];
  await page.$eval(
    ".timeline input",
    (slider, time) => {
      slider.value = String(time);
      slider.dispatchEvent(new Event("input"));
    },
    (near.from + near.to) / 2,
  );
  const state = await text(page, ".display .state");
  assert.match(state, new RegExp(`Least distance\\s+${near.distance.toFixed(2).replace(".", "\\.")} mm`));
  assert.ok(state.includes(near.solid), state);
  const drawn = await page.$eval(".marks", (canvas) => {
    const { width, height } = canvas;
    const scale = width / canvas.getBoundingClientRect().width;
    const from = Math.round(12 * scale);
    const { data } = canvas.getContext("2d").getImageData(0, from, width, height - from);
    let count = 0;
    for (let i = 3; i < data.length; i += 4) count += Number(data[i] > 60);
    return count;
  });
  assert.ok(drawn > 100, `${drawn} points of the curve`);
  // The same to a scale: the lowest point of the curve is the least distance, the first row of the list too.
  await page.click('.side-tabs [data-tab="run"]');
  const shown = await page.$eval(".plot.clearance svg", (svg) => {
    const labels = [...svg.querySelectorAll("text.end")].filter((label) => /^\d+$/.test(label.textContent));
    const [zero, other] = [labels[0], labels.at(-1)].map((label) => ({ y: Number(label.getAttribute("y")), mm: Number(label.textContent) }));
    const heights = [...svg.querySelector(".measured").getAttribute("d").matchAll(/[ML][\d.]+ ([\d.]+)/g)].map(([, y]) => Number(y));
    return (other.mm * (zero.y - 3 - Math.max(...heights))) / (zero.y - other.y);
  });
  assert.ok(Math.abs(shown - near.distance) < 0.05, `${shown} instead of ${near.distance}`);
  assert.match(await text(page, ".plot.clearance + table tr"), new RegExp(`^${near.distance.toFixed(2).replace(".", "\\.")} mm\\s[\\s\\S]*${near.solid}`));
  assert.deepEqual(problems, []);
  await page.close();
});

for (const width of [1400, 800]) {
  test(`no text of the sheet runs into its neighbour in any language, ${width} px`, async () => {
    const { page, problems } = await open("housing", { width, height: 1000, graphics: false });
    assert.ok(await page.$(".with-truth .row"));
    for (const code of ["de", "ru", "sv", "zh", "pl", "en"]) {
      await page.select(".page-buttons select", code);
      await settle(page);
      const wide = await page.$$eval(".sheet-head > *, .row.result > *", (cells) =>
        cells.filter((cell) => cell.clientWidth > 0 && cell.scrollWidth > cell.clientWidth + 1).map((cell) => cell.textContent));
      assert.deepEqual(wide, [], code);
    }
    assert.deepEqual(problems, []);
    await page.close();
  });
}

test("alarms and cycles speak the language of the page", async () => {
  const { page, problems } = await open("alarm", { graphics: false });
  const heads = new Set();
  for (const [code, name] of [["de", "Antastpunkt nicht erreichbar"], ["ru", "Точка касания недоступна"], ["sv", "Avkänningspunkt kan ej nås"], ["zh", "触点不可达"], ["pl", "Punkt próbkowania nieosiągalny"], ["en", "Touch point inaccessible"]]) {
    await page.select(".page-buttons select", code);
    await stageIsThere(page);
    await settle(page);
    assert.ok((await text(page, ".headline")).includes(name), `${code}: ${await text(page, ".headline")}`);
    assert.ok((await text(page, ".notes .note.alarm")).includes(name), code);
    const diagnosis = await text(page, ".note.diagnosis");
    assert.equal(/ further in /.test(diagnosis), code === "en", diagnosis);
    heads.add(await text(page, ".cycle-head"));
  }
  assert.equal(heads.size, 6);
  assert.deepEqual(problems, []);
  await page.close();
});

/** How far a screenshot is from a stored picture: mean difference of colours, and the share of points that are far off. */
const difference = (page, first, second) =>
  page.evaluate(
    async (sources) => {
      const pixels = await Promise.all(
        sources.map(async (source) => {
          const image = new Image();
          image.src = `data:image/png;base64,${source}`;
          await image.decode();
          // Coarse, so that the edges of letters do not count.
          const canvas = document.createElement("canvas");
          [canvas.width, canvas.height] = [Math.round(image.width / 4), Math.round(image.height / 4)];
          const context = canvas.getContext("2d");
          context.imageSmoothingQuality = "high";
          context.drawImage(image, 0, 0, canvas.width, canvas.height);
          return { size: `${image.width} x ${image.height}`, data: context.getImageData(0, 0, canvas.width, canvas.height).data };
        }),
      );
      if (pixels[0].size !== pixels[1].size) return { size: pixels.map(({ size }) => size).join(" and "), mean: 255, far: 1 };
      const [{ data: a }, { data: b }] = pixels;
      let [sum, far] = [0, 0];
      for (let i = 0; i < a.length; i += 4) {
        const off = Math.max(Math.abs(a[i] - b[i]), Math.abs(a[i + 1] - b[i + 1]), Math.abs(a[i + 2] - b[i + 2]));
        sum += off;
        far += Number(off > 48);
      }
      return { size: pixels[0].size, mean: sum / (a.length / 4), far: far / (a.length / 4) };
    },
    [first, second],
  );

const pictures = {
  sheet: { run: "housing" },
  plots: {
    run: "housing",
    act: async (page) => {
      await page.evaluate(() => document.querySelectorAll(".cycle-head")[3].querySelector(".toggle").click());
      await settle(page);
      await page.$eval(".plot", (plot) => plot.scrollIntoView({ block: "center" }));
    },
  },
  lathe: { run: "lathe", height: 700 },
  dark: { run: "alarm", dark: true },
  phone: { run: "housing", width: 390, height: 844 },
};

for (const [name, { run, width, height, dark, act }] of Object.entries(pictures)) {
  test(`looks as it did: ${name}`, async () => {
    const { page, problems } = await open(run, { width, height, dark });
    // Dates and folders are other ones each time.
    await page.addStyleTag({ content: ".run, .page-head .facts { visibility: hidden !important }" });
    if (act) await act(page);
    await settle(page);
    const shot = Buffer.from(await page.screenshot()).toString("base64");
    if (screenshots) writeFileSync(join(screenshots, `${name}.png`), Buffer.from(shot, "base64"));
    const file = join(stored, `${name}.png`);
    if (update) writeFileSync(file, Buffer.from(shot, "base64"));
    assert.ok(existsSync(file), `${file} is missing: PROBEWRIGHT_UPDATE_PICTURES=1 makes it`);
    const off = await difference(page, shot, readFileSync(file).toString("base64"));
    assert.ok(off.mean < 4 && off.far < 0.02, `${name}: ${JSON.stringify(off)}`);
    // The comparison sees what it is for: without the sheet it is another picture.
    await page.addStyleTag({ content: "main > *, .stage canvas { visibility: hidden !important }" });
    await settle(page);
    const spoilt = await difference(page, Buffer.from(await page.screenshot()).toString("base64"), shot);
    assert.ok(spoilt.mean > 4 || spoilt.far > 0.02, `${name}: ${JSON.stringify(spoilt)}`);
    assert.deepEqual(problems, []);
    await page.close();
  });
}
