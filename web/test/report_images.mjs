// Makes the pictures of the documents from reports. Usage: node report_images.mjs REPORT LATHE_REPORT FOLDER

import { mkdtempSync, rmSync } from "node:fs";
import { tmpdir } from "node:os";
import { join, resolve } from "node:path";
import { pathToFileURL } from "node:url";
import puppeteer from "puppeteer-core";

const [report, lathe, folder] = process.argv.slice(2);
const userDataDir = mkdtempSync(join(tmpdir(), "probewright-images-"));
const browser = await puppeteer.launch({
  executablePath: process.env.CHROMIUM ?? "/usr/bin/chromium",
  headless: true,
  userDataDir,
  args: ["--no-sandbox", "--use-angle=swiftshader", "--enable-unsafe-swiftshader", "--force-color-profile=srgb"],
});

const settle = (page) => page.evaluate(() => new Promise((done) => requestAnimationFrame(() => setTimeout(done, 300))));

async function picture(file, name, { width = 1400, height = 900, dark = false } = {}, act = async () => {}) {
  const page = await browser.newPage();
  await page.setViewport({ width, height });
  await page.emulateMediaFeatures([{ name: "prefers-color-scheme", value: dark ? "dark" : "light" }]);
  await page.goto(pathToFileURL(resolve(file)).href);
  await page.waitForSelector(".stage canvas");
  await settle(page);
  await act(page);
  await settle(page);
  await page.screenshot({ path: join(folder, name) });
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
await browser.close();
rmSync(userDataDir, { recursive: true, force: true, maxRetries: 3 });
