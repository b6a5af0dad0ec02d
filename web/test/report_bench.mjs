// Measures pages in Chromium: size, time until their first rows are on the screen, until the picture is, scrolling.
// Processor time counts where other work on the computer would show in elapsed time.
// Usage: node report_bench.mjs PROBEWRIGHT REPOSITORY [CYCLES]

import { execFileSync } from "node:child_process";
import { mkdtempSync, readFileSync, rmSync, statSync, writeFileSync } from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { pathToFileURL } from "node:url";
import puppeteer from "puppeteer-core";
import { scrolled } from "./scrolled.mjs";

const [program, repository, wanted = "2000"] = process.argv.slice(2);
if (!/^[1-9]\d{0,5}$/.test(wanted)) {
  console.error(`report-bench: the number of cycles is a whole number from 1 to 999999, not "${wanted}"`);
  process.exit(2);
}
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

/** A report of this program; its exit code does not matter. */
function run(name, file, setup) {
  const out = join(folder, name);
  try {
    execFileSync(program, ["run", file, "--setup", join(repository, "examples/setups", setup), "--out", out, "--quiet"], { stdio: "ignore" });
  } catch (error) {
    if (error.status !== 1) throw error;
  }
  return join(out, "report.html");
}

/** The page's own clock, from the click on the file: when what `rows` names is on the screen, and the canvas. */
function watch(rows) {
  const seen = {};
  window.benchSeen = seen;
  // A frame later than what is there, it has been drawn.
  const look = () => {
    for (const [name, selector] of [["rows", rows], ["picture", "canvas[data-engine]"]])
      if (!(name in seen) && document.querySelector(selector)) requestAnimationFrame(() => (seen[name] ??= performance.now()));
    if (!("rows" in seen && "picture" in seen)) requestAnimationFrame(look);
  };
  requestAnimationFrame(look);
}

/** Processor time of the pages so far, all threads, s: the same on a busy machine. */
async function pageSeconds(browser) {
  const session = await browser.target().createCDPSession();
  const { processInfo } = await session.send("SystemInfo.getProcessInfo");
  await session.detach();
  return processInfo.filter(({ type }) => type === "renderer").reduce((sum, { cpuTime }) => sum + cpuTime, 0);
}

async function measure(browser, file, rows) {
  const before = await pageSeconds(browser);
  const page = await browser.newPage();
  await page.setViewport({ width: 1400, height: 900 });
  await page.evaluateOnNewDocument(watch, rows);
  await page.goto(pathToFileURL(file).href);
  await page.waitForFunction(() => "rows" in window.benchSeen && "picture" in window.benchSeen, { timeout: 120_000 });
  const seconds = (await pageSeconds(browser)) - before;
  return { page, seconds, ...(await page.evaluate(() => window.benchSeen)) };
}

/** What this computer takes for the simplest list that there is: without a graphics card the drawing is most of a frame. */
async function plainList(browser) {
  const page = await browser.newPage();
  await page.setViewport({ width: 1400, height: 900 });
  const lines = Array.from({ length: 4000 }, (_, i) => `<div>Line ${i}: 12.345 mm</div>`).join("");
  await page.setContent(`<div class="list" style="height:860px;overflow:auto;font:14px sans-serif">${lines}</div>`);
  const seen = await scrolled(page, ".list");
  await page.close();
  return seen;
}

try {
  const many = join(folder, "many.h");
  writeFileSync(many, manyCycles(Number(wanted)));
  const machine = join(folder, "machine.html");
  execFileSync(program, ["machine", "mill5-table-table", "--out", machine], { stdio: "ignore" });
  const programs = join(repository, "examples/programs");
  const pages = [
    ["housing, 10 cycles", run("housing", join(programs, "housing.h"), "housing-tnc640.toml"), ".cycle-head"],
    ["shaft on a lathe", run("shaft", join(programs, "shaft.mpf"), "shaft-lathe.toml"), ".cycle-head"],
    [`housing, ${wanted} cycles`, run("many", many, "housing-tnc640.toml"), ".cycle-head"],
    ["machine, 5 axes", machine, "[data-axis]"],
  ];
  const browser = await puppeteer.launch({
    executablePath: process.env.CHROMIUM ?? "/usr/bin/chromium",
    headless: true,
    userDataDir: join(folder, "browser"),
    protocolTimeout: 900_000,
    args: ["--no-sandbox", "--use-angle=swiftshader", "--enable-unsafe-swiftshader"],
  });
  // The first page of a browser pays for its start.
  await (await measure(browser, pages[0][1], ".cycle-head")).page.close();
  console.log("page                    size       rows    picture   processor time of the page");
  for (const [name, file, rows] of pages) {
    const seen = await measure(browser, file, rows);
    console.log(`${name.padEnd(22)}${(statSync(file).size / 1e6).toFixed(1).padStart(4)} MB ${seen.rows.toFixed(0).padStart(7)} ms ${seen.picture.toFixed(0).padStart(7)} ms ${(1000 * seen.seconds).toFixed(0).padStart(7)} ms`);
    if (!name.includes(wanted)) {
      await seen.page.close();
      continue;
    }
    const sheet = await scrolled(seen.page, ".sheet");
    const plain = await plainList(browser);
    console.log(`  elements ${sheet.elements}; scrolling by 400 pixels a frame: ${sheet.own.toFixed(1)} ms processor time of the page a frame, from frame to frame ${sheet.median.toFixed(0)} ms, of a hundred ${sheet.worst.toFixed(0)} ms`);
    console.log(`  a list of plain lines as long: ${plain.own.toFixed(1)} ms, from frame to frame ${plain.median.toFixed(0)} ms, of a hundred ${plain.worst.toFixed(0)} ms`);
    await seen.page.close();
  }
  await browser.close();
} finally {
  rmSync(folder, { recursive: true, force: true, maxRetries: 3 });
}
