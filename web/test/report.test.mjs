// Opens the sample reports from disk in Chromium, as a user would, and looks at what is there.
// Usage: node report.test.mjs FOLDER_OF_SAMPLES [FOLDER_FOR_SCREENSHOTS]

import assert from "node:assert/strict";
import { existsSync, mkdirSync, mkdtempSync, rmSync } from "node:fs";
import { tmpdir } from "node:os";
import { join, resolve } from "node:path";
import { after, before, test } from "node:test";
import { pathToFileURL } from "node:url";
import puppeteer from "puppeteer-core";

const [samples, pictures] = process.argv.slice(2);
const executablePath = [process.env.CHROMIUM, "/usr/bin/chromium", "/usr/bin/chromium-browser", "/usr/bin/google-chrome"].find(
  (path) => path && existsSync(path),
);
const userDataDir = mkdtempSync(join(tmpdir(), "probewright-chromium-"));
let browser;

before(async () => {
  assert.ok(executablePath, "Chromium is needed: apt-get install chromium, or name it in CHROMIUM");
  if (pictures) mkdirSync(pictures, { recursive: true });
  browser = await puppeteer.launch({
    executablePath,
    headless: true,
    userDataDir,
    args: [
      "--no-sandbox",
      "--use-angle=swiftshader",
      "--enable-unsafe-swiftshader",
      "--disable-quic",
      "--no-first-run",
      "--disable-background-networking",
      "--disable-component-update",
      "--disable-sync",
      "--force-color-profile=srgb",
    ],
  });
});

after(async () => {
  await browser?.close();
  rmSync(userDataDir, { recursive: true, force: true, maxRetries: 3 });
});

/** A report, settled; fails on any error in the page and on any request that leaves the file. */
async function open(name, { width = 1600, height = 1000, dark = false } = {}) {
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
  await page.goto(pathToFileURL(resolve(samples, name)).href);
  await page.waitForSelector("#report main");
  await settle(page);
  return { page, problems };
}

const settle = (page) =>
  page.evaluate(() => new Promise((done) => requestAnimationFrame(() => requestAnimationFrame(() => setTimeout(done, 150)))));

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

test("a part out of tolerance", async () => {
  const { page, problems } = await open("rework.html");
  assert.match(await text(page, ".headline"), /Out of tolerance\s+1 of 5 toleranced values outside the limits/);
  assert.match(await text(page, "h1"), /BEARING_BLOCK\.H/);
  assert.match(await text(page, ".run"), /TNC640/);
  assert.match(await text(page, ".facts-line"), /5\s+cycles\s+15\s+touches\s+2\.31 m\s+path\s+1 min 35 s/);

  const rows = await page.$$eval("#results tr.result", (all) =>
    all.map((row) => [...row.cells].map((cell) => cell.innerText.trim())),
  );
  assert.deepEqual(
    rows.find((row) => row[0] === "Q155"),
    ["Q155", "actual value, side length in the minor axis", "80.0541", "mm", "80.0000", "+0.0541", "79.9700", "80.0300", "", "Rework"],
  );
  assert.deepEqual(
    rows.find((row) => row[0] === "Q153" && row[9] === "OK"),
    ["Q153", "actual value, diameter", "30.0119", "mm", "30.0000", "+0.0119", "30.0000", "30.0210", "", "OK"],
  );
  assert.equal(rows.length, 10);
  // The bore lies at 0.0119 / 0.021 of its tolerance.
  assert.equal(
    await page.$eval("#cycle-3 tr.result:nth-child(4) .tolerance", (bar) => bar.title),
    "at 57 % of the tolerance",
  );

  const corrections = await page.$$eval("#corrections tbody tr", (all) => all.map((row) => row.innerText.split("\t")));
  assert.deepEqual(corrections[1], ["PRESET.PR", "row 5, column Z", "-412.300", "-412.086", "+0.214", "2 417"]);
  assert.equal(corrections.length, 5);
  assert.match(await text(page, "#events"), /BORE 30\.012 \/ WIDTH 80\.054/);
  assert.match(await text(page, ".line.has-cycle.rework"), /13 TCH PROBE 424/);
  assert.equal((await page.$$(".line.has-cycle")).length, 5);

  // The verdict of a line stands beside its text, however long that is.
  const apart = await page.$$eval(".line.has-cycle", (lines) =>
    lines.map((line) => line.querySelector("code").getBoundingClientRect().left - line.querySelector(".line-badge").getBoundingClientRect().right),
  );
  assert.ok(apart.length === 5 && apart.every((gap) => gap >= 0), `${apart}`);

  const content = await canvasContent(page);
  assert.ok(content.share > 0.15 && content.share < 0.95, `drawn share ${content.share}`);
  assert.ok(content.colours > 200, `${content.colours} colours`);
  await picture(page, "rework", { fullPage: true });
  assert.deepEqual(problems, []);
  await page.close();
});

test("clicking touches, lines and results leads to one another", async () => {
  const { page, problems } = await open("rework.html");
  // A line of the program selects its cycle everywhere.
  await page.evaluate(() => document.querySelectorAll(".line.has-cycle")[3].click());
  await settle(page);
  assert.ok(await page.$("#cycle-3.selected"));
  assert.match(await text(page, ".touch-card"), /421 Measure a hole\s+line 43[\s\S]*4 touches/);
  assert.equal((await page.$$(".label")).length, 4);

  // A dot in the view shows its touch.
  const plain = await canvasContent(page);
  const dot = await dotOf(page, 1);
  await page.mouse.click(dot.x, dot.y);
  await settle(page);
  const card = await text(page, ".touch-card");
  assert.match(card, /Touch \d of 4/);
  assert.match(card, /Outcome\s+touched/);
  assert.match(card, /Deviation\s+[\u2212+]?\d\.\d{4} mm/);
  await picture(page, "touch");
  const chosen = Number(/Touch (\d) of/.exec(card)[1]);
  assert.ok(await page.$(`#cycle-3 tr.touch.selected[data-touch="${chosen - 1}"]`));
  assert.notDeepEqual(await canvasContent(page), plain, "the probe stands at the touch");

  // Its neighbour, from the card; the third touch of the bore, seen from the part's centre, lies to the left.
  await page.$$eval("#cycle-3 tr.touch", (rows) => rows[2].click());
  await settle(page);
  assert.match(await text(page, ".touch-card"), /Touch 3 of 4[\s\S]*Ball centre\s+7\.994/);
  assert.match(await text(page, ".touch-card"), /Axes\s+X 307\.994\s+Y 300\.000\s+Z 285\.000/);
  await page.click('.touch-card [aria-label="Next touch"]');
  assert.match(await text(page, ".touch-card"), /Touch 4 of 4/);

  // A result's line link marks the line.
  await page.click("#cycle-4 .line-link");
  await settle(page);
  assert.match(await text(page, ".line.selected"), /13 TCH PROBE 424/);
  await page.keyboard.press("Escape");
  assert.equal(await page.$eval(".touch-card", (element) => element.hidden), true);
  assert.deepEqual(problems, []);
  await page.close();
});

test("view buttons, switches and replay change the picture", async () => {
  const { page, problems } = await open("rework.html");
  const seen = new Set();
  const press = async (name) => {
    await page.$$eval(".toolbar button", (all, wanted) => all.find((b) => b.innerText.trim() === wanted).click(), name);
    await settle(page);
    const content = await canvasContent(page);
    assert.ok(content.share > 0.05, `${name} shows something`);
    return `${content.share} ${content.colours}`;
  };
  for (const name of ["Top", "Front", "Right", "Fit", "Iso"]) {
    seen.add(await press(name));
    await picture(page, `view-${name.toLowerCase()}`);
  }
  assert.equal(seen.size, 5);
  for (const name of ["X-ray", "Path", "Touches", "Fixtures"]) seen.add(await press(name));
  assert.equal(seen.size, 9);
  await page.$eval(".replay input", (slider) => {
    slider.value = String(Number(slider.max) / 3);
    slider.dispatchEvent(new Event("input"));
  });
  await settle(page);
  const { share, colours } = await canvasContent(page);
  assert.ok(!seen.has(`${share} ${colours}`), "the probe stands somewhere");
  assert.notEqual(await text(page, ".replay output"), "0.0 s");

  // Dragging turns the part; it does not select.
  const stage = await (await page.$(".stage canvas")).boundingBox();
  await page.mouse.move(stage.x + 200, stage.y + 300);
  await page.mouse.down();
  await page.mouse.move(stage.x + 320, stage.y + 340, { steps: 4 });
  await page.mouse.up();
  await settle(page);
  assert.equal(await page.$eval(".touch-card", (element) => element.hidden), true);
  assert.deepEqual(problems, []);
  await page.close();
});

test("an alarm", async () => {
  const { page, problems } = await open("alarm.html", { dark: true });
  assert.match(await text(page, ".headline"), /Alarm\s+Touch point inaccessible: no contact[\s\S]*BEARING_BLOCK\.H, line 27/);
  assert.match(await text(page, "#cycle-2"), /Alarm[\s\S]*Touch point inaccessible/);
  assert.match(await text(page, ".event.alarm"), /33\.7 s\s+Alarm\s+Touch point inaccessible/);
  // The place of the collision stands in the view, which begins wide enough for it and for the gauge touched first.
  assert.match(await text(page, ".label.collision"), /^Collision: stylus, Fixed jaw$/);
  const stage = await (await page.$(".stage")).boundingBox();
  await page.$$eval("#cycle-0 .cycle-line", ([line]) => line.click());
  await settle(page);
  const dots = await page.$$eval(".label", (labels) =>
    labels.map((label) => {
      const at = new DOMMatrix(getComputedStyle(label).transform);
      return { x: at.e, y: at.f };
    }),
  );
  assert.equal(dots.length, 4, "two touches of the edge, one of the gauge, the collision");
  for (const { x, y } of dots) assert.ok(x > 0 && x < stage.width && y > 0 && y < stage.height, `a label at ${x}, ${y}`);
  assert.ok(await page.$(".label.collision"), "it stays when touches are shown");
  await page.keyboard.press("Escape");
  await page.click("#cycle-2 .toggle");
  await page.$$eval("#cycle-2 tr.touch", (rows) => rows[1].click());
  await settle(page);
  assert.match(await text(page, ".touch-card"), /Outcome\s+no contact[\s\S]*Deviation\s+\u2013/);
  assert.equal(await page.evaluate(() => document.documentElement.dataset.theme), "dark");
  await picture(page, "alarm-dark", { fullPage: true });
  assert.deepEqual(problems, []);
  await page.close();
});

test("a good part, on a small screen", async () => {
  const { page, problems } = await open("good.html", { width: 1024, height: 768 });
  assert.match(await text(page, ".headline"), /OK\s+All 3 toleranced values within the limits/);
  assert.ok(await page.evaluate(() => document.documentElement.scrollWidth <= innerWidth), "nothing sticks out sideways");
  // What has no nominal value stays folded with the parameters until asked for.
  assert.doesNotMatch(await text(page, "#cycle-3"), /Q180/);
  assert.match(await text(page, "#cycle-3 .toggle"), /4 touches, \d+ parameters, 1 further result$/);
  await page.click("#cycle-3 .toggle");
  assert.match(await text(page, "#cycle-3 .details"), /Further results\s+Q180\s+1\s+1: good/);
  await picture(page, "good-small", { fullPage: true });
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
  await page.evaluateOnNewDocument(() => {
    const original = HTMLCanvasElement.prototype.getContext;
    HTMLCanvasElement.prototype.getContext = function (kind, ...rest) {
      return kind.startsWith("webgl") ? null : original.call(this, kind, ...rest);
    };
  });
  await page.goto(pathToFileURL(resolve(samples, "rework.html")).href);
  await page.waitForSelector("#report main");
  await settle(page);
  assert.match(await text(page, ".stage"), /shows no 3D graphics/);
  assert.equal((await page.$$("#results tr.result")).length, 10);
  await page.close();
});

test("on paper", async () => {
  const { page, problems } = await open("rework.html", { dark: true });
  const pdf = await page.pdf({ format: "A4", printBackground: true, ...(pictures ? { path: join(pictures, "print.pdf") } : {}) });
  assert.ok(pdf.length > 20000);
  assert.deepEqual(problems, []);
  await page.close();
});
