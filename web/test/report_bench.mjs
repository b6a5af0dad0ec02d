// Measures the report of a run with many cycles in Chromium: size, time until the first rows stand there, scrolling.
// Usage: node report_bench.mjs PROBEWRIGHT REPOSITORY [CYCLES]

import { execFileSync } from "node:child_process";
import { mkdtempSync, readFileSync, rmSync, statSync, writeFileSync } from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { pathToFileURL } from "node:url";
import puppeteer from "puppeteer-core";

const [program, repository, wanted = "2000"] = process.argv.slice(2);
const folder = mkdtempSync(join(tmpdir(), "probewright-bench-"));

/** The housing's bore and spigot, measured again and again under new names. */
function manyCycles(count) {
  const lines = readFileSync(join(repository, "examples/programs/housing.h"), "utf8").split(/\r?\n/);
  const from = lines.findIndex((line) => line.includes("INSPECT: BORE"));
  const to = lines.findIndex((line) => line.includes("INSPECT: POCKET"));
  const round = lines.slice(from, to).filter((line) => !line.includes("CALL LBL"));
  const text = lines.slice(0, from);
  for (let i = 0; i < count / 2; ++i) text.push(...round.map((line) => (line.includes("* -") ? `${line} NO ${i + 1}` : line)));
  text.push("9 END PGM HOUSING MM");
  let block = 0;
  return text.map((line) => line.replace(/^\d+/, () => String(block++))).join("\n");
}

try {
  writeFileSync(join(folder, "many.h"), manyCycles(Number(wanted)));
  const out = join(folder, "out");
  execFileSync(program, ["run", join(folder, "many.h"), "--setup", join(repository, "examples/setups/housing-tnc640.toml"), "--out", out, "--quiet"]);
  const report = join(out, "report.html");
  console.log(`size             ${(statSync(report).size / 1e6).toFixed(1)} MB`);
  const browser = await puppeteer.launch({
    executablePath: process.env.CHROMIUM ?? "/usr/bin/chromium",
    headless: true,
    userDataDir: join(folder, "browser"),
    args: ["--no-sandbox", "--use-angle=swiftshader", "--enable-unsafe-swiftshader"],
  });
  const page = await browser.newPage();
  await page.setViewport({ width: 1400, height: 900 });
  const begin = performance.now();
  await page.goto(pathToFileURL(report).href);
  await page.waitForFunction(() => document.querySelectorAll(".cycle-head").length > 5, { polling: 20 });
  const rows = performance.now();
  await page.waitForSelector(".stage canvas");
  const { cycles, elements, frames } = await page.evaluate(async () => {
    const sheet = document.querySelector(".sheet");
    const frames = [];
    let last = performance.now();
    for (let i = 0; i < 120; ++i) {
      sheet.scrollTop += 400;
      await new Promise((done) => requestAnimationFrame(done));
      frames.push(performance.now() - last);
      last = performance.now();
    }
    return { cycles: document.querySelector(".sheet").getAttribute("aria-rowcount"), elements: document.querySelectorAll("*").length, frames };
  });
  frames.sort((a, b) => a - b);
  console.log(`cycles           ${cycles}`);
  console.log(`rows after       ${(rows - begin).toFixed(0)} ms`);
  console.log(`picture after    ${(performance.now() - begin - frames.reduce((sum, x) => sum + x, 0)).toFixed(0)} ms, drawn by the processor`);
  console.log(`elements         ${elements}`);
  console.log(`frame, scrolling ${frames[60].toFixed(0)} ms, of a hundred ${frames[118].toFixed(0)} ms`);
  await browser.close();
} finally {
  rmSync(folder, { recursive: true, force: true, maxRetries: 3 });
}
