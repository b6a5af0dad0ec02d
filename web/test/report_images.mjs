// Makes the pictures of the documents from reports. Usage: node report_images.mjs REPORT LATHE_REPORT FOLDER, then
// NAME=REPORT for each alarm that has a picture.

import { mkdtempSync, rmSync } from "node:fs";
import { tmpdir } from "node:os";
import { join, resolve } from "node:path";
import { pathToFileURL } from "node:url";
import puppeteer from "puppeteer-core";

const [report, lathe, folder, ...alarms] = process.argv.slice(2);
const userDataDir = mkdtempSync(join(tmpdir(), "probewright-images-"));
const browser = await puppeteer.launch({
  executablePath: process.env.CHROMIUM ?? "/usr/bin/chromium",
  headless: true,
  userDataDir,
  args: ["--no-sandbox", "--use-angle=swiftshader", "--enable-unsafe-swiftshader", "--force-color-profile=srgb"],
});

const settle = (page) => page.evaluate(() => new Promise((done) => requestAnimationFrame(() => setTimeout(done, 300))));

async function picture(file, name, { width = 1400, height = 900, dark = false, of = null } = {}, act = async () => {}) {
  const page = await browser.newPage();
  await page.setViewport({ width, height });
  await page.emulateMediaFeatures([{ name: "prefers-color-scheme", value: dark ? "dark" : "light" }]);
  await page.goto(pathToFileURL(resolve(file)).href);
  await page.waitForSelector(".stage canvas");
  await settle(page);
  await act(page);
  await settle(page);
  await (of ? await page.$(of) : page).screenshot({ path: join(folder, name) });
  await page.close();
}

await picture(report, "report.png", { height: 1000 });
await picture(report, "report-details.png", {}, async (page) => {
  await page.evaluate(() => document.querySelector("#cycle-3").click());
  await page.keyboard.press("o");
  await page.keyboard.press("d");
});
await picture(report, "report-replay.png", { dark: true }, async (page) => {
  await page.$eval(".replay input", (slider) => {
    slider.value = String(Number(slider.max) * 0.42);
    slider.dispatchEvent(new Event("input"));
  });
});
await picture(report, "report-phone.png", { width: 390, height: 844 });
await picture(lathe, "report-lathe.png", { height: 700 });
for (const alarm of alarms) {
  const [name, file] = alarm.split("=");
  // Where the probe stopped, seen near, with what the simulator knows of it.
  await picture(file, `${name}.png`, { of: ".stage" }, async (page) => {
    await page.addStyleTag({ content: ".toolbar, .touch-card, .legend { visibility: hidden !important }" });
    await page.$eval(".timeline input", (slider) => {
      slider.value = slider.max;
      slider.dispatchEvent(new Event("input"));
    });
    // A touch that failed is seen near, what the body ran into from further away.
    const near = await page.$(".label.ghost");
    await page.keyboard.press(near ? "n" : "f");
    await new Promise((done) => setTimeout(done, 1500));
  });
}
await browser.close();
rmSync(userDataDir, { recursive: true, force: true, maxRetries: 3 });
