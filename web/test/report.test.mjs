// Opens the sample reports from disk in Chromium, as a user would, and looks at what is there.
// Usage: node report.test.mjs FOLDER_OF_SAMPLES [FOLDER_FOR_SCREENSHOTS]

import assert from "node:assert/strict";
import { mkdirSync } from "node:fs";
import { join, resolve } from "node:path";
import { test } from "node:test";
import { pathToFileURL } from "node:url";
import { browser, settle, withoutGraphics } from "./chromium.mjs";

const [samples, pictures] = process.argv.slice(2);
if (pictures) mkdirSync(pictures, { recursive: true });

/** A report, settled; fails on any error in the page and on any request that leaves the file. */
async function open(name, { width = 1400, height = 900, dark = false, graphics = true, hash = "" } = {}) {
  const page = await browser.newPage();
  const problems = [];
  page.on("pageerror", (error) => problems.push(String(error)));
  page.on("console", (message) => {
    // Reading pixels back is this test's own doing.
    if (["error", "warn"].includes(message.type()) && !message.text().includes("GPU stall due to ReadPixels")) problems.push(message.text());
  });
  page.on("request", (request) => {
    if (!/^(file|data|blob):/.test(request.url())) problems.push(`request of ${request.url()}`);
  });
  await page.setViewport({ width, height });
  await page.emulateMediaFeatures([{ name: "prefers-color-scheme", value: dark ? "dark" : "light" }]);
  await page.goto(pathToFileURL(resolve(samples, name)).href + hash);
  await page.waitForSelector("#report main");
  if (graphics) await page.waitForSelector(".stage canvas");
  await settle(page);
  return { page, problems };
}

const picture = async (page, name, options = {}) => {
  if (pictures) await page.screenshot({ path: join(pictures, `${name}.png`), ...options });
};

const text = (page, selector) => page.$eval(selector, (element) => element.innerText);

/** How many pixels of the canvas are drawn, and how many different colours stand there. */
const canvasContent = (page) =>
  page.$eval(".stage canvas", (canvas) => {
    const copy = document.createElement("canvas");
    copy.width = canvas.width;
    copy.height = canvas.height;
    const context = copy.getContext("2d");
    context.drawImage(canvas, 0, 0);
    const { data } = context.getImageData(0, 0, copy.width, copy.height);
    const colours = new Set();
    let drawn = 0;
    for (let i = 0; i < data.length; i += 4) {
      if (data[i + 3] > 0) ++drawn;
      colours.add((data[i] << 16) | (data[i + 1] << 8) | data[i + 2]);
    }
    return { share: drawn / (data.length / 4), colours: colours.size };
  });

/** The middle of a touch's number in the view; the dot itself lies a little below and to the left. */
const dotOf = (page, number) =>
  page.$$eval(
    ".label",
    (labels, wanted) => {
      const label = labels.find((candidate) => candidate.innerText.trim() === wanted);
      const stage = document.querySelector(".stage").getBoundingClientRect();
      const at = new DOMMatrix(getComputedStyle(label).transform);
      return { x: stage.left + at.e, y: stage.top + at.f };
    },
    String(number),
  );

/** The cells of all rows of the sheet that are in the page. */
const rowsOf = (page) => page.$$eval(".result.row", (rows) => rows.map((row) => [...row.children].map((cell) => cell.innerText.replace(/\s+/g, " ").trim())));

const press = (page, name) => page.$$eval(".toolbar button", (all, wanted) => all.find((button) => button.innerText.trim() === wanted).click(), name);

test("a part out of tolerance", async () => {
  const { page, problems } = await open("rework.html");
  assert.match(await text(page, ".headline"), /Out of tolerance\s+1 of 5 toleranced values outside the limits/);
  assert.match(await text(page, "h1"), /BEARING_BLOCK\.H/);
  assert.match(await text(page, ".run"), /TNC640/);
  assert.match(await text(page, ".facts-line"), /5 cycles\s*15 touches\s*path 2\.31 m\s*time 1 min 35 s/);

  const rows = await rowsOf(page);
  assert.equal(rows.length, 10);
  const width = rows.find((row) => row[1].includes("Q155"));
  assert.equal(width[2], "80.0000");
  assert.equal(width[3], "80.0300 79.9700");
  assert.equal(width[4], "80.0541mm");
  assert.equal(width[5], "+0.0541");
  // 0.0541 of the 0.03 that it may lie off the middle.
  assert.equal(width[6], "180 %");
  assert.equal(width[7], "Rework");
  const diameter = rows.find((row) => row[1].includes("Q153") && row[7] === "OK");
  // The middle of 30.000 to 30.021 is 30.0105.
  assert.deepEqual(diameter.slice(2), ["30.0000", "30.0210 30.0000", "30.0119mm", "+0.0119", "13 %", "OK"]);

  await page.click('.side-tabs [data-tab="corrections"]');
  const corrections = await page.$$eval("#corrections tbody tr", (all) => all.map((row) => row.innerText.split("\t")));
  assert.deepEqual(corrections[1], ["PRESET.PR", "row 5, column Z", "-412.300", "-412.086", "+0.214", "2 417"]);
  assert.equal(corrections.length, 5);
  await page.click('.side-tabs [data-tab="messages"]');
  assert.match(await text(page, "#events"), /BORE 30\.012 \/ WIDTH 80\.054/);
  await page.click('.side-tabs [data-tab="run"]');
  assert.match(await text(page, '.panel[data-tab="run"]'), /Time per cycle[\s\S]*421/);

  const content = await canvasContent(page);
  assert.ok(content.share > 0.15 && content.share < 0.95, `drawn share ${content.share}`);
  assert.ok(content.colours > 200, `${content.colours} colours`);
  assert.deepEqual(problems, []);
  await page.close();
});

test("clicking touches, lines and results leads to one another", async () => {
  const { page, problems } = await open("rework.html");
  // A result selects its cycle everywhere; the picture goes there.
  const whole = await canvasContent(page);
  await page.evaluate(() => document.querySelector("#cycle-3").click());
  await settle(page);
  assert.ok(await page.$("#cycle-3.selected"));
  assert.match(await text(page, ".line.selected"), /12 TCH PROBE 421/);
  assert.match(await text(page, ".touch-card"), /421 Measure a hole[\s\S]*4 touches/);
  assert.notDeepEqual(await canvasContent(page), whole, "the picture shows the feature");
  assert.equal((await page.$$(".label:not(.arrow) b")).length, 4);

  // A dot in the view shows its touch.
  const dot = await dotOf(page, 1);
  await page.mouse.click(dot.x, dot.y);
  await settle(page);
  const card = await text(page, ".touch-card");
  assert.match(card, /Touch \d of 4/);
  assert.match(card, /Outcome\s+touched/);
  assert.match(card, /Deviation\s+[\u2212+]?\d\.\d{4} mm/);
  const chosen = Number(/Touch (\d) of/.exec(card)[1]);
  await page.waitForSelector(`tr.touch.selected[data-cycle="3"][data-touch="${chosen - 1}"]`);
  await picture(page, "touch");

  await page.$$eval('tr.touch[data-cycle="3"]', (rows) => rows[2].click());
  await settle(page);
  assert.match(await text(page, ".touch-card"), /Touch 3 of 4[\s\S]*Ball centre\s+7\.994/);
  assert.match(await text(page, ".touch-card"), /Axes\s+X 307\.994\s+Y 300\.000\s+Z 285\.000/);
  await page.click('.touch-card [aria-label="Next touch"]');
  assert.match(await text(page, ".touch-card"), /Touch 4 of 4/);
  await page.keyboard.press("Escape");
  assert.equal(await page.$eval(".touch-card", (element) => element.hidden), true);
  assert.deepEqual(problems, []);
  await page.close();
});

test("filters, folded rows and the way from failure to failure", async () => {
  const { page, problems } = await open("rework.html");
  const button = (name) => page.$$eval(".filters button", (all, wanted) => all.find((each) => each.innerText === wanted).click(), name);
  await button("Out of tolerance");
  await settle(page);
  assert.deepEqual((await rowsOf(page)).map((row) => row[7]), ["Rework"]);
  assert.match(await text(page, ".filters .count:last-child"), /1 of 5/);
  await button("Out of tolerance");
  await page.select(".filters select", "421");
  await settle(page);
  assert.equal((await page.$$(".cycle-head")).length, 1);
  await page.select(".filters select", "");
  await page.keyboard.press("/");
  await page.keyboard.type("diameter");
  await settle(page);
  const found = await page.$$eval(".cycle-head", (heads) => heads.map((head) => head.innerText));
  assert.ok(found.length >= 1 && found.length < 5, found.join());
  await page.$eval(".filters input", (input) => {
    input.value = "";
    input.dispatchEvent(new Event("input"));
  });
  await page.keyboard.press("Escape");
  // Folded: what is good shows its head only.
  await button("Fold good");
  await settle(page);
  assert.ok((await rowsOf(page)).length < 10);
  await page.keyboard.press("n");
  await settle(page);
  assert.ok(await page.$("#cycle-4.selected"));
  assert.match(await text(page, ".failures"), /1 of 1/);
  assert.deepEqual(problems, []);
  await page.close();
});

test("the form of what was measured", async () => {
  const { page, problems } = await open("rework.html");
  await page.evaluate(() => document.querySelector("#cycle-3 .toggle").click());
  await settle(page);
  const plots = await page.$$eval(".plot", (all) => all.map((plot) => plot.textContent));
  // Residuals of 1, -1, 2 and -2 um; the centre lies 0.8 um and -0.5 um off.
  assert.ok(plots.some((plot) => /^Roundness0\.0040 mm.*2: \u22121\.0 \u00b5m/.test(plot)), plots.join("\n"));
  assert.ok(plots.some((plot) => /^Position0\.0009 mm.*\+0\.8 \u00b5m, \u22120\.5 \u00b5m/.test(plot)), plots.join("\n"));
  await picture(page, "details");
  assert.deepEqual(problems, []);
  await page.close();
});

test("view buttons, switches, deviations and replay change the picture", async () => {
  const { page, problems } = await open("rework.html");
  const seen = new Set();
  const look = async (name) => {
    await press(page, name);
    await settle(page);
    const content = await canvasContent(page);
    assert.ok(content.share > 0.05, `${name} shows something`);
    return `${content.share} ${content.colours}`;
  };
  for (const name of ["Top", "Front", "Right", "Fit", "Iso"]) {
    seen.add(await look(name));
    await picture(page, `view-${name.toLowerCase()}`);
  }
  assert.equal(seen.size, 5);
  for (const name of ["X-ray", "Path", "Touches", "Fixtures", "Deviations"]) seen.add(await look(name));
  assert.equal(seen.size, 10);
  // As the keyboard and the slider of the magnification do.
  const label = await text(page, ".magnifier output");
  await page.$eval(".magnifier input", (slider) => {
    slider.value = slider.max;
    slider.dispatchEvent(new Event("input"));
  });
  assert.equal(label, "100\u00d7");
  assert.equal(await text(page, ".magnifier output"), "5000\u00d7");
  await page.$eval(".replay input", (slider) => {
    slider.value = String(Number(slider.max) / 3);
    slider.dispatchEvent(new Event("input"));
  });
  await settle(page);
  assert.notEqual(await text(page, ".replay .clock"), "0.0 s");
  const before = await text(page, ".replay .clock");
  await page.click('.replay [aria-label^="Touch on"]');
  assert.notEqual(await text(page, ".replay .clock"), before);
  assert.match(await text(page, ".touch-card"), /Touch \d of/);
  await page.keyboard.press("+");
  await page.keyboard.press(" ");
  await new Promise((done) => setTimeout(done, 400));
  await page.keyboard.press(" ");
  assert.notEqual(await text(page, ".replay .clock"), before);

  // Dragging turns the part; it does not select.
  await page.keyboard.press("Escape");
  const stage = await (await page.$(".stage canvas")).boundingBox();
  await page.mouse.move(stage.x + 200, stage.y + 260);
  await page.mouse.down();
  await page.mouse.move(stage.x + 320, stage.y + 290, { steps: 4 });
  await page.mouse.up();
  await settle(page);
  assert.equal(await page.$eval(".touch-card", (element) => element.hidden), true);
  assert.deepEqual(problems, []);
  await page.close();
});

test("an alarm", async () => {
  const { page, problems } = await open("alarm.html", { dark: true });
  assert.match(await text(page, ".headline"), /Alarm\s+Touch point inaccessible: no contact[\s\S]*BEARING_BLOCK\.H, line 27/);
  assert.match(await text(page, ".notes .note.alarm"), /Touch point inaccessible/);
  await page.click('.side-tabs [data-tab="messages"]');
  assert.match(await text(page, ".event.alarm"), /33\.7 s\s+Alarm\s+Touch point inaccessible/);
  // The place of the collision stands in the view.
  assert.match(await text(page, ".label.collision"), /^Collision: stylus, Fixed jaw$/);
  await page.click('.side-tabs [data-tab="inspection"]');
  await page.evaluate(() => document.querySelector("#cycle-2 .toggle").click());
  await settle(page);
  await page.$$eval('tr.touch[data-cycle="2"]', (rows) => rows[1].click());
  await settle(page);
  assert.ok(await page.$(".label.collision"), "it stays when touches are shown");
  assert.match(await text(page, ".touch-card"), /Outcome\s+no contact[\s\S]*Deviation\s+\u2013/);
  assert.equal(await page.evaluate(() => document.documentElement.dataset.theme), "dark");
  await picture(page, "alarm-dark");
  assert.deepEqual(problems, []);
  await page.close();
});

for (const [width, height] of [[1400, 900], [800, 1000], [390, 844]]) {
  for (const dark of [false, true]) {
    test(`${width} px, ${dark ? "dark" : "light"}`, async () => {
      const { page, problems } = await open("good.html", { width, height, dark });
      assert.match(await text(page, ".headline"), /OK\s+All 3 toleranced values within the limits/);
      assert.ok(await page.evaluate(() => document.documentElement.scrollWidth <= innerWidth), "nothing sticks out sideways");
      assert.ok(await page.evaluate(() => document.documentElement.scrollHeight <= innerHeight), "the page itself does not scroll");
      // Every cell lies within its row, and the row within the list.
      const outside = await page.$$eval(".result.row > *", (cells) =>
        cells.filter((cell) => {
          const [inner, outer] = [cell.getBoundingClientRect(), cell.closest(".sheet").getBoundingClientRect()];
          return inner.width > 0 && (inner.right > outer.right + 1 || inner.left < outer.left - 1);
        }).length,
      );
      assert.equal(outside, 0);
      for (const tab of await page.$$(".side-tabs .tab")) {
        if (!(await tab.isVisible())) continue;
        await tab.click();
        const panel = await page.$eval("main", (main) => main.dataset.tab);
        assert.ok(await page.$eval(panel === "program" ? "#program" : `.panel[data-tab="${panel}"]`, (element) => element.clientHeight > 80), panel);
      }
      await page.$$eval(".side-tabs .tab", ([first]) => first.click());
      await settle(page);
      await picture(page, `good-${width}-${dark ? "dark" : "light"}`);
      assert.deepEqual(problems, []);
      await page.close();
    });
  }
}

test("every language, switched in the page", async () => {
  const { page, problems } = await open("rework.html");
  const titles = new Set();
  for (const [code, word] of [["de", "Nacharbeit"], ["ru", "Доработка"], ["sv", "Efterbearbetning"], ["zh", "修复"], ["pl", "Poprawka"], ["en", "Rework"]]) {
    await page.select(".page-buttons select", code);
    await page.waitForSelector(".stage canvas");
    await settle(page);
    assert.equal(await page.evaluate(() => document.documentElement.lang), code);
    assert.ok((await rowsOf(page)).some((row) => row[7] === word), word);
    titles.add(await text(page, ".headline strong"));
    assert.ok(await page.evaluate(() => document.documentElement.scrollWidth <= innerWidth), `${code}: nothing sticks out sideways`);
    assert.deepEqual(await page.evaluate(() => [...document.querySelectorAll("*")].filter((element) => element.childElementCount === 0 && /\{\w+\}/.test(element.textContent) && !element.closest("script,style,#program")).length), 0, "no text keeps a place for a value");
    await picture(page, `language-${code}`);
  }
  assert.equal(titles.size, 6);
  assert.deepEqual(problems, []);
  await page.close();
});

test("a cycle whose words stand in its own file", async () => {
  const { page, problems } = await open("settings.html");
  assert.match(await page.evaluate(() => document.body.innerText), /FAST PROBING/);
  for (const [code, title] of [["de", "Schnelles Antasten"], ["zh", "快速探测"]]) {
    await page.select(".page-buttons select", code);
    await settle(page);
    const shown = await page.evaluate(() => document.body.innerText);
    assert.ok(shown.includes(title), shown);
    assert.ok(!shown.includes("FAST PROBING"), code);
  }
  assert.deepEqual(problems, []);
  await page.close();
});

test("a run that came to nothing", async () => {
  const { page, problems } = await open("empty.html");
  assert.match(await text(page, "#results"), /did not reach a measuring cycle/);
  assert.match(await text(page, "#program"), /not in this report/);
  assert.deepEqual(problems, []);
  await page.close();
});

test("what a camera saw", async () => {
  const { page, problems } = await open("camera.html");
  await page.click('.side-tabs [data-tab="camera"]');
  assert.match(await text(page, "#camera"), /1\s+601\s+image 11 of PLATE\.OS\s+Error found/);
  assert.match(await text(page, "#camera"), /average of 10 images\s+Taken[\s\S]*None\s+Compared: not compared/);
  const sizes = await page.$$eval("#camera img", (images) => images.map((image) => [image.naturalWidth, image.naturalHeight]));
  assert.deepEqual(sizes, [[3, 2], [3, 2]]);
  assert.deepEqual(problems, []);
  await page.close();
  const without = await open("good.html");
  assert.equal(await without.page.$("#camera"), null);
  await without.page.close();
});

test("texts that look like markup", async () => {
  const { page, problems } = await open("hostile.html");
  assert.equal(await page.evaluate(() => window.broken), undefined);
  assert.match(await text(page, "#cycle-0"), /<\/script><script>window\.broken = true<\/script><img src=x/);
  assert.match(await text(page, ".line"), /<\/script>.*\u6d4b\u91cf/);
  assert.deepEqual(problems, []);
  await page.close();
});

test("a browser without 3D graphics", async () => {
  const page = await browser.newPage();
  await page.setViewport({ width: 1400, height: 900 });
  await withoutGraphics(page);
  await page.goto(pathToFileURL(resolve(samples, "rework.html")).href);
  await page.waitForSelector(".stage .empty");
  assert.match(await text(page, ".stage"), /shows no 3D graphics/);
  assert.equal((await rowsOf(page)).length, 10);
  await page.close();
});

test("on paper", async () => {
  const { page, problems } = await open("rework.html", { dark: true, hash: "#print" });
  await page.waitForSelector("#paper", { hidden: false }).catch(() => {});
  await page.emulateMediaType("print");
  await settle(page);
  // The same rows and verdicts as on the screen, all of them, with a picture and the head.
  const rows = await page.$$eval(".paper-sheet tbody tr:not(.paper-cycle)", (all) => all.map((row) => row.innerText.replace(/\s+/g, " ")));
  assert.ok(rows.some((row) => /Q155 80\.0000 80\.0300 79\.9700 80\.0541\s?mm \+0\.0541 180 % Rework/.test(row)), rows.join("\n"));
  assert.equal(rows.filter((row) => /^\d+\.\d+ /.test(row)).length, 10);
  assert.ok(await page.$eval(".paper-picture canvas", (canvas) => canvas.width > 500));
  assert.match(await text(page, "#paper .paper-facts"), /TNC640[\s\S]*Probewright/);
  assert.equal(await page.$eval("#report", (element) => getComputedStyle(element).display), "none");
  const pdf = Buffer.from(await page.pdf({ preferCSSPageSize: true, printBackground: true, ...(pictures ? { path: join(pictures, "print.pdf") } : {}) }));
  assert.ok(pdf.length > 20000);
  const pages = pdf.toString("latin1").match(/\/Type\s*\/Page[^s]/g).length;
  assert.ok(pages >= 1 && pages <= 4, `${pages} pages`);
  assert.deepEqual(problems, []);
  await page.close();
});
