// One Chromium for the tests of a file: graphics in software, the same colours everywhere, no traffic of its own.

import assert from "node:assert/strict";
import { existsSync, mkdtempSync, rmSync } from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { after, before } from "node:test";
import puppeteer from "puppeteer-core";

const executablePath = [process.env.CHROMIUM, "/usr/bin/chromium", "/usr/bin/chromium-browser", "/usr/bin/google-chrome"].find(
  (path) => path && existsSync(path),
);
const userDataDir = mkdtempSync(join(tmpdir(), "probewright-chromium-"));

/** There as soon as the first test begins. */
export let browser;

before(async () => {
  assert.ok(executablePath, "Chromium is needed: apt-get install chromium, or name it in CHROMIUM");
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
      "--hide-scrollbars",
    ],
  });
});

after(async () => {
  await browser?.close();
  rmSync(userDataDir, { recursive: true, force: true, maxRetries: 3 });
});

/** Pages of this one come without 3D graphics: drawing in software is most of the time that a page takes, and tests of its text need none. */
export const withoutGraphics = (page) =>
  page.evaluateOnNewDocument(() => {
    const original = HTMLCanvasElement.prototype.getContext;
    HTMLCanvasElement.prototype.getContext = function (kind, ...rest) {
      return kind.startsWith("webgl") ? null : original.call(this, kind, ...rest);
    };
  });

/** The place of the picture, drawn or not. */
export const stageIsThere = (page) => page.waitForSelector(".stage canvas, .stage .empty");

/** Until nothing in the page has moved for a few frames. */
export const settle = (page, milliseconds = 200) =>
  page.evaluate((more) => new Promise((done) => requestAnimationFrame(() => requestAnimationFrame(() => setTimeout(done, more)))), milliseconds);
