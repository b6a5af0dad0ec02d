// Opens the pages of the ready-made machines in Chromium and moves their axes.
// Usage: node machine.test.mjs FOLDER_OF_PAGES [FOLDER_FOR_SCREENSHOTS]

import assert from "node:assert/strict";
import { mkdirSync, readFileSync } from "node:fs";
import { join, resolve } from "node:path";
import { test } from "node:test";
import { pathToFileURL } from "node:url";
import { browser, settle } from "./chromium.mjs";

const [samples, pictures] = process.argv.slice(2);
const expected = JSON.parse(readFileSync(join(samples, "expected.json"), "utf8"));

if (pictures) mkdirSync(pictures, { recursive: true });

async function open(name, { ready = "#machine main canvas", width = 1400, height = 900, dark = false } = {}) {
  const page = await browser.newPage();
  const problems = [];
  page.on("pageerror", (error) => problems.push(String(error)));
  page.on("request", (request) => {
    if (!/^(file|data|blob):/.test(request.url())) problems.push(`request of ${request.url()}`);
  });
  // A busy machine draws slowly in software.
  page.setDefaultTimeout(120_000);
  page.setDefaultNavigationTimeout(120_000);
  await page.setViewport({ width, height });
  await page.emulateMediaFeatures([{ name: "prefers-color-scheme", value: dark ? "dark" : "light" }]);
  await page.goto(pathToFileURL(resolve(samples, name)).href);
  await page.waitForSelector(ready);
  await settle(page);
  return { page, problems };
}

const slide = (page, axis, value) =>
  page.$eval(
    `[data-axis="${axis}"] input[type=range]`,
    (slider, wanted) => {
      slider.value = String(wanted);
      slider.dispatchEvent(new Event("input"));
    },
    value,
  );

const numbers = (text) => [...text.replaceAll("\u2212", "-").matchAll(/-?\d+\.\d+/g)].map(Number);

for (const [name, { axes, links, tip }] of Object.entries(expected)) {
  test(`the sliders of ${name} move its links`, async () => {
    const { page, problems } = await open(`${name}.html`);
    for (const [axis, value] of Object.entries(axes)) await slide(page, axis, value);
    await settle(page);
    const drawn = await page.evaluate(() => window.probewrightLinks());
    for (const { chain, elements, pose } of links) {
      const link = drawn.find((candidate) => candidate.chain === chain && candidate.elements === elements);
      link.pose.forEach((value, i) => assert.ok(Math.abs(value - pose[i]) < 1e-9 * Math.max(1, Math.abs(pose[i])), `${chain} ${elements} [${i}]: ${value}, not ${pose[i]}`));
    }
    const shown = numbers(await page.$eval("#tip-table", (element) => element.innerText));
    shown.forEach((value, i) => assert.ok(Math.abs(value - tip[i]) < 0.0006, `tip ${value}, not ${tip[i]}`));
    const letters = await page.$$eval(".axis-name:not(.frame)", (all) => all.map((element) => element.innerText));
    for (const axis of Object.keys(axes)) assert.ok(letters.some((letter) => letter.startsWith(axis)), `${axis} among ${letters}`);
    if (pictures) await page.screenshot({ path: join(pictures, `${name}.png`) });
    assert.deepEqual(problems, []);
    await page.close();
  });
}

test("by keyboard alone, in the dark, on a narrow screen", async () => {
  const { page, problems } = await open("mill5-table-table.html", { width: 390, height: 844, dark: true });
  assert.equal(await page.$eval(":root", (root) => root.dataset.theme), "dark");
  const width = await page.evaluate(() => document.documentElement.scrollWidth);
  assert.ok(width <= 390, `${width} px wide`);
  await page.focus("#axis-A");
  for (let i = 0; i < 3; ++i) await page.keyboard.press("ArrowRight");
  await page.keyboard.down("Shift");
  await page.keyboard.press("ArrowRight");
  await page.keyboard.up("Shift");
  assert.equal(await page.$eval('[data-axis="A"] input[type=number]', (field) => field.value), "13");
  // Beyond the travel it does not go.
  for (const key of ["Tab"]) await page.keyboard.press(key);
  await page.keyboard.type("500\n");
  assert.equal(await page.$eval("#axis-A", (slider) => slider.value), "120");
  await page.keyboard.press("Tab");
  await page.keyboard.press("Enter");
  assert.equal(await page.$eval("#axis-A", (slider) => slider.value), "0");
  if (pictures) await page.screenshot({ path: join(pictures, "narrow.png"), fullPage: true });
  assert.deepEqual(problems, []);
  await page.close();
});

test("what is typed moves the axis as far as it goes, and the field says where it is", async () => {
  const { page, problems } = await open("mill5-table-table.html");
  const type = async (axis, value) => {
    const field = `[data-axis="${axis}"] input[type=number]`;
    await page.click(field, { clickCount: 3 });
    await page.keyboard.press("Backspace");
    await page.keyboard.type(value);
    await page.keyboard.press("Enter");
    return [await page.$eval(field, (element) => element.value), await page.$eval(`#axis-${axis}`, (slider) => slider.value)];
  };
  assert.deepEqual(await type("A", "35.5"), ["35.5", "35.5"]);
  assert.deepEqual(await type("A", "999"), ["120", "120"]);
  // Nothing, or no number, moves nothing.
  assert.deepEqual(await type("A", ""), ["120", "120"]);
  assert.deepEqual(await type("A", "-"), ["120", "120"]);
  // An axis without end stops goes on.
  assert.deepEqual(await type("C", "270"), ["-90", "-90"]);
  assert.deepEqual(problems, []);
  await page.close();
});

test("says which way plus is", async () => {
  const { page } = await open("mill5-table-table.html");
  const text = await page.$eval('[data-axis="C"]', (row) => row.innerText);
  assert.match(text, /tool turns about \+Z: the workpiece turns about \u2212Z/);
  await page.close();
});

test("the replay of a report moves the machine about the part, and the part with the machine", async () => {
  const { page, problems } = await open("report.html", { ready: ".stage canvas" });
  const wanted = JSON.parse(readFileSync(join(samples, "report.json"), "utf8"));
  const press = (text) =>
    page.evaluate((name) => [...document.querySelectorAll(".toolbar button")].find((button) => button.innerText === name).click(), text);
  const compare = async (frame) => {
    const drawn = await page.evaluate(() => window.probewrightLinks());
    for (const link of wanted) {
      const { pose } = drawn.find(({ chain, elements }) => chain === link.chain && elements === link.elements);
      // The path is packed in single precision.
      pose.forEach((value, i) => assert.ok(Math.abs(value - link[frame][i]) < 1e-3, `${frame} ${link.chain} ${link.elements} [${i}]: ${value}, not ${link[frame][i]}`));
    }
  };
  await page.$eval(".replay input", (slider) => {
    slider.value = slider.max;
    slider.dispatchEvent(new Event("input"));
  });
  await press("Machine");
  await settle(page);
  await compare("table");
  if (pictures) await page.screenshot({ path: join(pictures, "replay-part.png") });
  await press("Axes move");
  await settle(page);
  await compare("base");
  if (pictures) await page.screenshot({ path: join(pictures, "replay-machine.png") });
  assert.deepEqual(problems, []);
  await page.close();
});
