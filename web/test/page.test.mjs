// Opens reports of real runs in Chromium and compares what they say with results.json, closed forms and where things lie on the screen.
// Usage: node page.test.mjs FOLDER_OF_RUNS [FOLDER_FOR_SCREENSHOTS]

import assert from "node:assert/strict";
import { mkdirSync, readFileSync } from "node:fs";
import { join, resolve } from "node:path";
import { test } from "node:test";
import { pathToFileURL } from "node:url";
import { browser, settle, stageIsThere, withoutGraphics } from "./chromium.mjs";

const [runs, screenshots] = process.argv.slice(2);
const languages = ["de", "ru", "sv", "zh", "pl", "en"];

if (screenshots) mkdirSync(screenshots, { recursive: true });

/** Opens a report, lets `act` look at it, and fails on any error in the page. */
async function look(run, { width = 1400, height = 900, graphics = true } = {}, act) {
  const page = await browser.newPage();
  const problems = [];
  page.on("pageerror", (error) => problems.push(String(error)));
  page.on("console", (message) => {
    const expected = message.text().includes("GPU stall") || (!graphics && message.text().includes("Error creating WebGL context"));
    if (["error", "warn"].includes(message.type()) && !expected) problems.push(message.text());
  });
  page.setDefaultTimeout(120_000);
  page.setDefaultNavigationTimeout(120_000);
  await page.setViewport({ width, height });
  if (!graphics) await withoutGraphics(page);
  await page.goto(pathToFileURL(resolve(runs, run, "report.html")).href);
  await page.waitForSelector(graphics ? ".stage canvas" : ".stage .empty");
  await settle(page);
  await act(page);
  if (screenshots) await page.screenshot({ path: join(screenshots, `${run}-${width}.png`) });
  assert.deepEqual(problems, []);
  await page.close();
}

const resultsOf = (run) => JSON.parse(readFileSync(join(runs, run, "results.json"), "utf8"));
const text = (page, selector) => page.$eval(selector, (element) => element.innerText);
const speak = async (page, language) => {
  await page.select(".page-buttons select", language);
  await stageIsThere(page);
  await settle(page);
};
const openDetails = async (page, cycle) => {
  await page.evaluate((index) => document.querySelector(`#cycle-${index} .toggle`).click(), cycle);
  await page.waitForSelector(".detail-row .inner");
  await settle(page);
};

const number = (shown) => Number(shown.replace("\u2212", "-").replace(/[^-\d.]/g, ""));

/** What the display of the replay says at a time. */
async function displayAt(page, time) {
  await page.$eval(
    ".timeline input",
    (slider, wanted) => {
      slider.value = String(wanted);
      slider.dispatchEvent(new Event("input"));
    },
    time,
  );
  const { rows, state } = await page.$eval(".display", (display) => ({
    rows: [...display.querySelectorAll("tbody tr")].map((row) => [...row.children].map((cell) => cell.textContent)),
    state: Object.fromEntries([...display.querySelectorAll(".state div")].map((item) => [...item.children].map((part) => part.textContent))),
  }));
  return { names: rows.map(([name]) => name), preset: Object.fromEntries(rows.map(([name, value]) => [name, value])), machine: Object.fromEntries(rows.map(([name, , value]) => [name, number(value)])), state };
}

test("a lathe shows diameters, and its workpiece system does not turn with the spindle", async () => {
  const { cycles, totals } = resultsOf("lathe");
  await look("lathe", {}, async (page) => {
    let turning = 0;
    for (const time of [...Array(60).keys()].map((i) => 3 + (i * (totals.time - 3.2)) / 60)) {
      const { names, preset, machine, state } = await displayAt(page, time);
      assert.deepEqual(names, ["X", "Z", "C"], "no axis that the lathe lacks");
      if (!state.Tool.startsWith("T1")) continue;
      // The zero offset lies on the turning axis, the probe along Z: DIAMON doubles what the axis X reads.
      assert.ok(preset.X.startsWith("\u2300"), `${preset.X} at ${time}`);
      assert.ok(Math.abs(number(preset.X) - 2 * machine.X) < 0.002, `${time} s: ${preset.X} at ${machine.X}`);
      if (machine.C > 0.001 && machine.C < 179.999) {
        turning += 1;
        assert.equal(state["Feed rate"], "0 mm/min", `at ${time} only the spindle turns`);
      }
    }
    assert.ok(turning > 0, "the spindle was seen turning");
    for (const { axes, time } of cycles.flatMap(({ touches }) => touches)) {
      const { preset } = await displayAt(page, time);
      assert.ok(Math.abs(number(preset.X) - 2 * axes.X) < 0.02, `${preset.X} at the touch of ${time} s, X ${axes.X}`);
    }
    // N160 X120
    assert.equal((await displayAt(page, totals.time)).preset.X, "\u2300 +120.000");
  });
});

test("the position stands while the tool is changed", async () => {
  await look("housing", {}, async (page) => {
    const first = await displayAt(page, 0);
    let seen = 0;
    for (const time of [0.5, 1, 2, 3, 4, 5, 5.5]) {
      const { preset, machine, state } = await displayAt(page, time);
      if (state.Tool !== "none") break;
      seen += 1;
      assert.deepEqual({ preset, machine }, { preset: first.preset, machine: first.machine }, `${time} s`);
    }
    assert.ok(seen > 3, `${seen} times before the tool`);
  });
});

test("rows have the colour of their own verdict", async () => {
  await look("names", { graphics: false }, async (page) => {
    const colours = await page.$$eval(".result.row", (rows) =>
      rows
        .filter((row) => /Q15[123]/.test(row.innerText) && row.classList.contains("of-scrap"))
        .map((row) => ({ verdict: row.querySelector(".verdict").innerText.trim(), colour: getComputedStyle(row.querySelector(".actual")).color })),
    );
    const plain = await page.$eval("body", (body) => getComputedStyle(body).color);
    assert.deepEqual(colours.map(({ verdict }) => verdict), ["OK", "OK", "Scrap"]);
    assert.deepEqual(colours.map(({ colour }) => colour === plain), [true, true, false]);
  });
});

for (const width of [1400, 390]) {
  test(`a share of the tolerance of four digits stays in its cell, ${width} px`, async () => {
    await look("names", { width, height: 844, graphics: false }, async (page) => {
      const shares = await page.$$eval(".share span", (all) =>
        all.map((span) => ({ text: span.innerText, right: span.getBoundingClientRect().right, end: span.closest("[role=cell]").getBoundingClientRect().right })),
      );
      assert.ok(shares.some(({ text }) => /^\d{4} %$/.test(text)), shares.map(({ text }) => text).join());
      for (const { text, right, end } of shares) assert.ok(right <= end + 1, `${text} ends at ${right}, its cell at ${end}`);
    });
  });
}

test("a telephone shows the filter by cycle, nominal and true values", async () => {
  await look("housing", { width: 390, height: 844, graphics: false }, async (page) => {
    const seen = (selector) => page.$$eval(selector, (all) => all.filter((element) => element.textContent !== "" && element.getBoundingClientRect().width > 0).length);
    assert.equal(await seen(".filters select"), 1);
    for (const kind of ["nominal-value", "truth", "truth-error"]) assert.ok((await seen(`.result .${kind}`)) > 3, kind);
  });
});

/** Words that go on in the next line where nothing allows it. */
const brokenWords = (page, selector) =>
  page.$$eval(selector, (elements) => {
    const broken = [];
    for (const element of elements) {
      const walker = document.createTreeWalker(element, NodeFilter.SHOW_TEXT);
      for (let node = walker.nextNode(); node; node = walker.nextNode()) {
        const top = (at) => {
          const range = document.createRange();
          range.setStart(node, at);
          range.setEnd(node, at + 1);
          // The first letter of a line has an empty box at the end of the line before, too.
          return [...range.getClientRects()].at(-1)?.top ?? 0;
        };
        const letter = /(?!\p{Script=Han})\p{L}/u;
        for (let i = 1; i < node.data.length; ++i)
          if (letter.test(node.data[i - 1]) && letter.test(node.data[i]) && top(i) - top(i - 1) > 4) broken.push(node.data);
      }
    }
    return broken;
  }, selector);

for (const width of [1400, 800]) {
  test(`heads and characteristics break where words may be broken, ${width} px`, async () => {
    for (const run of ["kinematics", "lathe"]) {
      await look(run, { width, height: 1000, graphics: false }, async (page) => {
        for (const language of languages) {
          await speak(page, language);
          assert.deepEqual(await brokenWords(page, ".sheet-head > *, .result .characteristic > span"), [], `${run} ${language}`);
          const high = await page.$$eval(".result.row", (rows) => Math.max(...rows.map((row) => row.getBoundingClientRect().height)));
          assert.ok(high < 76, `${run} ${language}: a row of ${high} px`);
        }
      });
    }
  });
}

test("long names stay on the paper", async () => {
  await look("names", { graphics: false }, async (page) => {
    for (const language of languages) {
      await speak(page, language);
      await page.evaluate(() => dispatchEvent(new Event("beforeprint")));
      await page.emulateMediaType("print");
      // What the margins leave of A4.
      await page.setViewport({ width: 703, height: 900 });
      await settle(page);
      const outside = await page.$$eval("#paper td, #paper th, #paper h1, #paper h3, #paper dd, #paper .badge", (all) => {
        const paper = document.querySelector("#paper").getBoundingClientRect();
        return all.filter((element) => element.getBoundingClientRect().right > paper.right + 1 || element.scrollWidth > element.clientWidth + 1).map((element) => `${element.className} ${element.textContent.slice(0, 40)}`);
      });
      assert.deepEqual(outside.filter((text) => !text.startsWith("badge")), [], language);
      const badges = await page.$$eval("#paper .paper-sheet .badge", (all) => all.map((badge) => badge.getBoundingClientRect().toJSON()));
      assert.ok(badges.length > 10);
      for (const { width, height } of badges) assert.ok(height < 18 && width > height, `badge of ${width} x ${height}`);
      assert.deepEqual(await brokenWords(page, "#paper .paper-sheet thead th"), [], language);
      const foot = await page.$eval("#paper style", (style) => [...style.textContent.matchAll(/content: "([^"]*)"/g)].map(([, content]) => content));
      const wide = await page.evaluate((contents) => {
        const context = document.createElement("canvas").getContext("2d");
        context.font = "8pt sans-serif";
        return contents.map((content) => (context.measureText(content).width * 25.4) / 96);
      }, foot);
      assert.ok(wide[0] < 55 && wide[1] < 75, `${foot.join(" | ")}: ${wide.join()}`);
      assert.match(foot[0], /NOSPA[A-Z]*\u2026 +0017$/);
      await page.evaluate(() => dispatchEvent(new Event("afterprint")));
      await page.emulateMediaType("screen");
      await page.setViewport({ width: 1400, height: 900 });
    }
  });
});

test("points of a sphere are drawn to its scale", async () => {
  const { cycles } = resultsOf("kinematics");
  const [first] = cycles[1].fits;
  await look("kinematics", {}, async (page) => {
    await openDetails(page, 1);
    const { outline, middle, points } = await page.$eval(".plot svg", (svg) => {
      const at = (circle) => ["cx", "cy", "r"].map((name) => Number(circle.getAttribute(name)));
      const [cx, cy, r] = at(svg.querySelector("circle.nominal"));
      return { outline: r, middle: [cx, cy], points: [...svg.querySelectorAll(".inwards, .outwards")].map(at) };
    });
    assert.equal(points.length, first.touches.length);
    // The first touch is the pole, the others go straight towards the centre of the sphere: their balls lie on its equator.
    const places = first.touches.map((touch) => cycles[1].touches[touch]);
    const pole = places.findIndex(({ direction }) => Math.abs(direction[2]) > 0.99);
    points.forEach(([x, y], i) => {
      const away = Math.hypot(x - middle[0], y - middle[1]) / outline;
      assert.ok(Math.abs(away - (i === pole ? 0 : 1)) < 0.03, `touch ${first.touches[i] + 1} at ${away} of the radius`);
    });
  });
});

test("repeated touches are those of one point of the machine", async () => {
  const { cycles } = resultsOf("kinematics");
  const { touches } = cycles[1];
  await look("kinematics", {}, async (page) => {
    await openDetails(page, 1);
    const titles = await page.$$eval(".plot figcaption b", (all) => all.map((title) => title.innerText).filter((title) => title.startsWith("Repeated")));
    for (const title of titles) {
      const [, from, to] = /(\d+)\u2013(\d+)$/.exec(title) ?? [];
      const numbers = from ? [...Array(to - from + 1).keys()].map((i) => Number(from) + i) : title.match(/\d+/g).map(Number);
      const [{ axes: expected }, ...others] = numbers.map((touch) => touches[touch - 1]);
      for (const { axes } of others) for (const name of Object.keys(axes)) assert.ok(Math.abs(axes[name] - expected[name]) < 0.02, `${title}: ${name} ${axes[name]} and ${expected[name]}`);
    }
  });
});

const boxesOf = (page, selector) => page.$$eval(selector, (all) => all.map((element) => ({ text: element.innerText, ...element.getBoundingClientRect().toJSON() })));
const overlap = (a, b) => a.left < b.right && b.left < a.right && a.top < b.bottom && b.top < a.bottom;

test("the card lies beside what is selected, also with the display open", async () => {
  await look("housing", {}, async (page) => {
    await displayAt(page, 30);
    for (const cycle of [0, 2, 3, 4, 6]) {
      await page.evaluate((index) => {
        const list = document.querySelector(".sheet");
        for (list.scrollTop = 0; !document.querySelector(`#cycle-${index}`) && list.scrollTop < 1e5; list.scrollTop += 200) list.dispatchEvent(new Event("scroll"));
      }, cycle);
      await page.waitForSelector(`#cycle-${cycle}`);
      await page.evaluate((index) => document.querySelector(`#cycle-${index}`).click(), cycle);
      await settle(page);
      const [card] = await boxesOf(page, ".touch-card");
      const numbers = (await boxesOf(page, ".label:not(.arrow) b")).filter(({ text }) => /^\d+$/.test(text));
      assert.ok(card.height > 50 && numbers.length > 0, `cycle ${cycle}`);
      for (const label of numbers) assert.ok(!overlap(card, label), `cycle ${cycle}: touch ${label.text} under the card`);
    }
  });
});

for (const width of [1400, 800, 390]) {
  test(`what was expected and what is true have their names side by side, ${width} px`, async () => {
    await look("alarm", { width, height: 900 }, async (page) => {
      const labels = await boxesOf(page, ".label.ghost b");
      assert.deepEqual(labels.map(({ text }) => text).sort(), ["expected", "truly here"]);
      assert.ok(!overlap(labels[0], labels[1]), JSON.stringify(labels));
    });
  });
}

for (const width of [1400, 800]) {
  test(`the table of touches fits its place, ${width} px`, async () => {
    await look("housing", { width, graphics: false }, async (page) => {
      for (const language of ["ru", "de", "pl", "en"]) {
        await speak(page, language);
        await openDetails(page, 3);
        const { wide, room } = await page.$eval(".detail-row .scroll", (box) => ({ wide: box.scrollWidth, room: box.clientWidth }));
        assert.ok(wide <= room, `${language}: ${wide} px in ${room}`);
      }
    });
  });
}

test("codes of a call are explained in the language of the page", async () => {
  const expected = {
    de: "Messvariante: Au\u00dfendurchmesser, Werkzeug korrigieren, mit Umschlag der Drehspindel",
    ru: "вариант измерения: наружный диаметр, исправить инструмент, с переворотом токарного шпинделя",
    sv: "mätvariant: ytterdiameter, korrigera verktyget, med omslag av svarvspindeln",
    zh: "测量变体：外径，修正刀具，车削主轴反转",
    pl: "wariant pomiaru: średnica zewnętrzna, skorygować narzędzie, z odwróceniem wrzeciona tokarskiego",
    en: "measuring variant: outside diameter, correct the tool, with reversal of the turning spindle",
  };
  await look("lathe", { graphics: false }, async (page) => {
    for (const [language, meaning] of Object.entries(expected)) {
      await speak(page, language);
      await openDetails(page, 1);
      const shown = await page.$$eval(".parameters div", (all) => all.map((item) => item.innerText.split("\n").map((part) => part.trim())));
      assert.equal(shown.find(([name]) => name === "S_MVAR").at(-1), meaning);
      if (language !== "en") assert.doesNotMatch(shown.find(([name]) => name === "S_KNUM1").at(-1), /tool offset/);
    }
  });
});

test("a blind run explains no lines that are not there", async () => {
  await look("blind", {}, async (page) => {
    assert.doesNotMatch(await text(page, ".legend"), /Rapid|Feed|Measuring/);
    assert.doesNotMatch(await text(page, ".toolbar"), /Path/);
  });
  await look("housing", {}, async (page) => {
    assert.match(await text(page, ".legend"), /Rapid[\s\S]*Feed[\s\S]*Measuring/);
    assert.match(await text(page, ".toolbar"), /Path/);
  });
});

test("a run of tools alone is a page without errors", async () => look("lathe-tools", {}, async (page) => assert.match(await text(page, ".facts-line"), /cycle/)));
