// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
//
// Opens the pages that `porttool report --format html` writes in headless Chromium: this repository's own, one made of
// texts that try to break out of it, and one without anything to show.
// node page_test.mjs PORTTOOL REPOSITORY; exit 77 where node, Chromium or playwright-core is missing.
import assert from "node:assert/strict";
import { execFileSync, spawnSync } from "node:child_process";
import { existsSync, mkdirSync, mkdtempSync, readFileSync, rmSync, statSync, writeFileSync } from "node:fs";
import { tmpdir } from "node:os";
import { delimiter, join } from "node:path";
import { pathToFileURL } from "node:url";

const SKIPPED = 77;
const [porttool, repository] = process.argv.slice(2);

function skip(what) {
  console.log(`SKIPPED: ${what}; ./setup.sh installs it where the network is on`);
  process.exit(SKIPPED);
}

function findChromium() {
  const folders = (process.env.PATH || "").split(delimiter);
  const names = ["chromium", "chromium-browser", "google-chrome"];
  return names.flatMap((name) => folders.map((folder) => join(folder, name))).find((path) => existsSync(path));
}

const executablePath = process.env.CHROMIUM || findChromium();
if (!executablePath) skip("no chromium");
const { chromium } = await import("playwright-core").catch(() => skip("no playwright-core"));

const home = mkdtempSync(join(tmpdir(), "porttool-page-"));
const report = (folder, ...options) => execFileSync(porttool, ["-C", folder, "report", ...options], { maxBuffer: 1 << 28 });
const json = (folder, ...options) => JSON.parse(report(folder, "--format", "json", ...options));

function page(folder, name, ...options) {
  const file = join(home, name);
  report(folder, "--format", "html", "-o", file, ...options);
  return { url: pathToFileURL(file).href, bytes: statSync(file).size, text: readFileSync(file, "latin1") };
}

function repositoryOf(name, files) {
  const folder = join(home, name);
  for (const [path, text] of Object.entries(files)) {
    mkdirSync(join(folder, path, ".."), { recursive: true });
    writeFileSync(join(folder, path), text);
  }
  const init = spawnSync(porttool, ["-C", folder, "init", "--source", "src/*", "--target", "port/*"], { encoding: "utf8" });
  assert.equal(init.status, 0, init.stderr);
  return folder;
}

const browser = await chromium.launch({ executablePath, args: ["--no-sandbox"] });

// The page unpacks itself after it has loaded.
const ready = (tab) => tab.waitForFunction(() => document.documentElement.dataset.ready !== undefined);

// Opens a page and collects what must not happen: errors, and requests for anything but the page.
async function open(url, { width = 1280, height = 900, colorScheme = "light" } = {}) {
  const tab = await browser.newPage({ viewport: { width, height }, colorScheme, reducedMotion: "reduce" });
  tab.trouble = [];
  tab.on("console", (message) => { if (message.type() !== "log") tab.trouble.push(message.text()); });
  tab.on("pageerror", (error) => tab.trouble.push(error.message));
  tab.on("request", (request) => { if (!request.url().startsWith(url.split("#")[0]) && !request.url().startsWith("data:")) tab.trouble.push(request.url()); });
  await tab.goto(url);
  await ready(tab);
  return tab;
}

const texts = (tab, selector) => tab.$$eval(selector, (nodes) => nodes.map((node) => node.textContent));
const keys = (tab) => tab.$$eval("#list .unit", (nodes) => nodes.map((node) => node.dataset.key));
// Wider than its place: the page, or what scrolls within it.
const overflow = (tab) => tab.evaluate(() => [document.documentElement, ...document.querySelectorAll("dialog[open], dialog[open] .viewer-body")]
  .filter((node) => node.scrollWidth > node.clientWidth).map((node) => `${node.className || node.tagName}: ${node.scrollWidth} in ${node.clientWidth}`));

// Texts whose contrast with what lies behind them is below 4.5 : 1, as WCAG 2 defines it.
const faintTexts = (tab) => tab.evaluate(() => {
  const canvas = document.createElement("canvas").getContext("2d", { willReadFrequently: true });
  const luminance = (color) => {
    canvas.fillStyle = color;
    canvas.fillRect(0, 0, 1, 1);
    const [r, g, b] = [...canvas.getImageData(0, 0, 1, 1).data].map((c) => (c / 255 <= 0.04045 ? c / 255 / 12.92 : ((c / 255 + 0.055) / 1.055) ** 2.4));
    return 0.2126 * r + 0.7152 * g + 0.0722 * b;
  };
  const ground = (node) => {
    for (; node; node = node.parentElement) {
      const color = getComputedStyle(node).backgroundColor;
      if (!/^rgba\(.*, 0(\.[0-8]\d*)?\)$/.test(color)) return color;
    }
    return "white";
  };
  const faint = new Set();
  for (const node of document.body.querySelectorAll("*")) {
    const isText = [...node.childNodes].some((child) => child.nodeType === Node.TEXT_NODE && child.textContent.trim());
    if (!isText || node.getClientRects().length === 0 || node.closest("script, option")) continue;
    const picture = node.closest("svg"), tile = node.closest("[data-key]");
    const front = luminance(picture ? getComputedStyle(node).fill : getComputedStyle(node).color);
    const back = luminance(picture && tile ? getComputedStyle(tile.querySelector("rect")).fill : ground(picture || node));
    const ratio = (Math.max(front, back) + 0.05) / (Math.min(front, back) + 0.05);
    if (ratio < 4.5) faint.add(`${node.tagName} '${node.textContent.slice(0, 20)}' ${ratio.toFixed(2)}`);
  }
  return [...faint];
});

const tests = [];
const test = (name, run) => tests.push({ name, run });

// A port of texts that would end a script element, open a comment, close an attribute, or are no UTF-8.
const hostileSource = Buffer.concat([Buffer.from(`
__device__ float shade(float a, float b) {
  // </script><script>window.broken = 1</script> <!-- <img src=x onerror="window.broken = 2"> ' " &amp; \u2028\u202E\u{1F468}\u200D\u{1F469}
  const char* text = "</script><b>\\"'&lt;";
  float c = a * b; // `), Buffer.from([0xe4, 0xff, 0x80, 0xc0, 0xaf]), Buffer.from(`
  return c * 0.5f;
}
__device__ float ${"long".repeat(80)}(float a) { return a * 3.0f + ${"a".repeat(300)}; }
`)]);
const hostileTarget = `float shade(float a, float b) {
  float c = a * b;
  return c * 0.5;
}
float ${"long".repeat(80)}(float a) { return a * 3.0 + ${"a".repeat(300)}; }
`;
const hostile = repositoryOf("hostile", { "src/k<!--<script>.cu": hostileSource, "port/k.comp": hostileTarget });
writeFileSync(join(hostile, "src/k<!--<script>.cu"), Buffer.concat([hostileSource, Buffer.from("__device__ float fresh(float a) { return a / 7.0f; }\n")]));
const empty = repositoryOf("empty", { "src/a.cu": "// nothing here\n", "port/a.comp": "// nor here\n" });
const short = repositoryOf("short", { "src/a.cu": "#define A 3\n", "port/a.comp": "#define A 3\n" });
const giantText = (type) => `${type} float giant(float x) {\n${Array.from({ length: 20000 }, (_, i) => `  x = x * ${i}.0f + ${i % 7}.5f;`).join("\n")}\n  return x;\n}\n`;
const giant = repositoryOf("giant", { "src/g.cu": giantText("__device__"), "port/g.comp": giantText("") });

const own = page(repository, "own.html");
const ownJson = json(repository);

test("the page is one file below 2 MB that names no other", async () => {
  assert.ok(own.bytes < 2 * 1024 * 1024, `${own.bytes} bytes`);
  const shell = own.text.replace(/<script type="application\/json"[^]*?<\/script>/, "");
  assert.doesNotMatch(shell, /(?:src|href)="(?!#|data:)|url\(|@import|https?:\/\/(?!www\.w3\.org\/2000\/svg)/);
});

test("it loads without an error or a request, at both widths and in both themes; nothing overflows or is faint", async () => {
  const grounds = new Set();
  for (const width of [1280, 390]) {
    for (const colorScheme of ["light", "dark"]) {
      const tab = await open(own.url, { width, colorScheme });
      assert.deepEqual(await overflow(tab), []);
      if (width === 1280) assert.deepEqual(await faintTexts(tab), []);
      grounds.add(await tab.evaluate(() => getComputedStyle(document.body).backgroundColor));
      assert.deepEqual(tab.trouble, []);
      await tab.close();
    }
  }
  assert.equal(grounds.size, 2, "light and dark differ, and do not depend on the width");
});

test("its figures are those of --format json", async (tab) => {
  const inner = (value) => (value > 0 && value < 100 ? Math.min(99.9, Math.max(0.1, value)) : value);
  const percent = (value) => (value === null ? "too short" : `${inner(value).toFixed(1)} %`);
  const rows = await tab.$$eval("table.blocks tbody tr", (nodes) => nodes.map((row) => ({
    name: row.dataset.block, cells: [...row.querySelectorAll("td")].map((cell) => (cell.querySelector("a, .figure") || cell).textContent) })));
  const blocks = [...ownJson.blocks, { ...ownJson.totals, name: "All lines" }];
  assert.deepEqual(rows, blocks.map((block) => ({ name: block.name, cells: [
    block.source_lines.toLocaleString("en-US"), block.shared_source.toLocaleString("en-US"), percent(block.moss_percent_source),
    block.target_lines.toLocaleString("en-US"), block.shared_target.toLocaleString("en-US"), percent(block.moss_percent_target),
    block.degree_of_portability.loc.toFixed(2)] })));
  for (const side of ["source", "target"]) {
    const parts = ownJson.totals.decomposition[side];
    const shown = await texts(tab, `.fate:nth-child(${side === "source" ? 1 : 2}) .legend b`);
    assert.deepEqual(shown, ["twin", "rewritten", "one_sided", "unmatched"].map((kind) => parts[kind].toLocaleString("en-US")));
  }
  const { in_step: inStep, pairs } = ownJson.drift.summary;
  assert.match(await tab.textContent("#summary .lead"), new RegExp(`${inStep} of ${pairs} pairs in step`));
});

test("drift comes first, and no figure is more than two clicks from its formula", async (tab) => {
  const sections = await tab.$$eval("main > section[id]", (nodes) => nodes.filter((node) => !node.hidden).map((node) => node.id));
  assert.deepEqual(sections.slice(0, 3), ["summary", "ledger", "blocks"]);
  const inView = (id) => tab.evaluate((name) => {
    const box = document.getElementById(name).getBoundingClientRect();
    return !document.querySelector("dialog[open]") && box.top < innerHeight && box.bottom > 0;
  }, id);
  const formulas = { "how-shared": "tokens that lie in a match / its tokens", "how-degree": "1 − lines of the port that are not shared / its lines" };
  for (const [id, formula] of Object.entries(formulas)) assert.ok((await tab.textContent(`#${id}`)).includes(formula), id);
  for (const [head, id] of [["Lines", "how-lines"], ["Shared", "how-shared"], ["Moss %", "how-shared"], ["DP", "how-degree"]]) {
    await tab.locator("#blocks thead a", { hasText: head }).first().click();
    assert.ok(await inView(id), head);
  }
  await tab.click("#lines h3 a");
  assert.ok(await inView("how-parts"), "parts of all lines");
  await tab.locator(".tile", { hasText: "Shared" }).click();
  await tab.waitForSelector("dialog[open] .code");
  await tab.click("dialog .facts a");
  await tab.waitForFunction(() => !document.querySelector("dialog[open]"));
  assert.ok(await inView("how-shared"), "the tile's lines");
});

test("every figure of a block leads to as many lines", async (tab) => {
  const block = ownJson.blocks.find((one) => one.name === "BSDF");  // short enough to be drawn at once
  const links = await tab.$$eval(`tr[data-block="${block.name}"] td a`, (nodes) => nodes.map((node) => node.getAttribute("href")));
  const counts = [];
  for (const link of links) {
    await tab.evaluate((hash) => { location.hash = hash; }, link);
    await tab.waitForSelector("dialog[open] .code");
    counts.push(await tab.locator("dialog .code .row").count());
  }
  assert.deepEqual(counts, [block.source_lines, block.shared_source, block.target_lines, block.shared_target]);
});

test("the filters filter, by block, state and kind", async (tab) => {
  const block = "BSDF";
  const expected = (accepts) => ownJson.units.filter(accepts).map((row) => row.key);
  await tab.selectOption("#choose-block", block);
  assert.deepEqual(await keys(tab), expected((row) => row.blocks.includes(block)));
  await tab.selectOption("#choose-block", "");
  await tab.selectOption("#choose-kind", "rewritten");
  assert.deepEqual(await keys(tab), expected((row) => row.share === "rewritten"));
  await tab.selectOption("#choose-kind", "");
  await tab.selectOption("#choose-state", "deferred");
  assert.deepEqual(await keys(tab), expected((row) => row.state === "deferred"));
});

test("Enter in the search field opens the first match", async (tab) => {
  await tab.keyboard.press("/");
  await tab.keyboard.type("bsdf sample");
  const [first] = await keys(tab);
  await tab.keyboard.press("Enter");
  await tab.waitForFunction(() => document.querySelector("dialog").open);
  assert.equal(new URLSearchParams(new URL(tab.url()).hash.split("?")[1]).get("key"), first);
});

test("search searches, from the keyboard; a pair opens, moves on and closes without a mouse", async (tab) => {
  await tab.keyboard.press("/");
  await tab.keyboard.type("bsdf sample");
  const found = ownJson.units.filter((row) => ["bsdf", "sample"].every((word) =>
    [row.source, row.target].filter(Boolean).map((side) => side.id).join(" ").toLowerCase().includes(word))).map((row) => row.key);
  assert.ok(found.length > 1);
  assert.deepEqual(await keys(tab), found);
  for (let i = 0; i < 9 && !(await tab.evaluate(() => document.activeElement.classList.contains("unit"))); ++i) await tab.keyboard.press("Tab");
  await tab.keyboard.press("ArrowDown");
  await tab.keyboard.press("ArrowUp");
  await tab.keyboard.press("Enter");
  await tab.waitForSelector("dialog[open]");
  const title = await tab.textContent("#viewer-title");
  const row = ownJson.units.find((one) => one.key === found[0]);
  assert.match(title, new RegExp(row.source.name));
  const head = await tab.textContent("dialog .head");
  for (const side of ["source", "target"]) assert.ok(head.includes(`${row[side].file}:${row[side].line}`), head);
  await tab.keyboard.press("ArrowRight");
  await tab.waitForFunction((old) => document.getElementById("viewer-title").textContent !== old, title);
  await tab.keyboard.press("ArrowLeft");
  await tab.waitForFunction((old) => document.getElementById("viewer-title").textContent === old, title);
  await tab.keyboard.press("Escape");
  await tab.waitForFunction(() => !document.querySelector("dialog").open);
  assert.equal(await tab.evaluate(() => document.activeElement.dataset.key), found[0], "the focus returns to where it was");
});

test("the map of units is one tab stop; arrow keys move in it and Enter opens", async (tab) => {
  assert.equal(await tab.locator("#treemap [tabindex='0']").count(), 1);
  await tab.focus("#treemap [tabindex='0']");
  const key = () => tab.evaluate(() => document.activeElement.dataset.key);
  const first = await key();
  await tab.keyboard.press("ArrowRight");
  assert.notEqual(await key(), first);
  await tab.keyboard.press("Enter");
  await tab.waitForSelector("dialog[open]");
});

test("the theme can be switched by hand", async (tab) => {
  const ground = () => tab.evaluate(() => getComputedStyle(document.body).backgroundColor);
  const before = await ground();
  await tab.click("#theme");
  assert.notEqual(await ground(), before);
});

test("what is printed leaves out controls and keeps every unit", async (tab) => {
  await tab.emulateMedia({ media: "print" });
  await tab.evaluate(() => dispatchEvent(new Event("beforeprint")));
  assert.equal(await tab.locator(".tools").isVisible(), false);
  assert.equal((await keys(tab)).length, ownJson.units.length);
});

test("texts that try to break out stay texts", async () => {
  const made = page(hostile, "hostile.html");
  const tab = await open(made.url);
  assert.equal(await tab.evaluate(() => window.broken), undefined);
  assert.deepEqual(tab.trouble, []);
  assert.equal(await tab.locator("script").count(), 2);
  const key = json(hostile).units.find((row) => row.source && row.source.name === "shade").key;
  await tab.evaluate((wanted) => document.querySelector(`[data-key="${CSS.escape(wanted)}"].unit`).click(), key);
  await tab.waitForSelector("dialog[open]");
  const body = await tab.textContent("dialog .code");
  assert.ok(body.includes(`// </script><script>window.broken = 1</script> <!-- <img src=x onerror="window.broken = 2"> ' " &amp; \\u{2028}\\u{202e}\u{1F468}\u200D\u{1F469}`), body);
  assert.ok(body.includes("// \ufffd\ufffd\ufffd\ufffd\ufffd"), "each byte that is no UTF-8 shows as one sign");
  assert.deepEqual(await texts(tab, "dialog mark:not(.translated)"), [], "a comment is no difference");
  assert.equal(await tab.evaluate(() => window.broken), undefined);
  await tab.close();
});

test("names and lines of any length stay within their place", async () => {
  const { url } = page(hostile, "hostile.html");
  for (const width of [1280, 390]) {
    const tab = await open(url, { width });
    assert.deepEqual(await overflow(tab), []);
    await tab.fill("#choose-q", "longlong");
    await tab.click("#list .unit");
    await tab.waitForSelector("dialog[open] .code");
    assert.deepEqual(await overflow(tab), []);
    await tab.close();
  }
});

test("an open finding stands in the ledger with its remedy, and leads to its unit", async () => {
  const tab = await open(page(hostile, "hostile.html").url);
  assert.equal(await tab.textContent("#verdict"), "Drifted");
  assert.match((await texts(tab, "#ledger .entries > li")).join(), /unported.*fresh has no port.*porttool ignore/);
  await tab.click("#ledger .entries a");
  await tab.waitForSelector("dialog[open]");
  assert.equal(await tab.textContent("#viewer-title"), "fresh");
  await tab.close();
});

test("nothing to show is said, not left blank", async () => {
  const tab = await open(page(empty, "empty.html").url, { width: 390 });
  assert.deepEqual(tab.trouble, []);
  assert.match(await tab.textContent("#summary"), /No units are paired yet/);
  assert.match(await tab.textContent("#blocks"), /No functional blocks/);
  assert.match(await tab.textContent("#lines"), /No code on either side/);
  assert.match(await tab.textContent("#ledger"), /Nothing drifted/);
  assert.equal(await tab.locator("#more").isVisible(), false);
  assert.deepEqual(await overflow(tab), []);
  await tab.close();
});

test("what is too short is called so, once; a side without code has no percent", async () => {
  const tab = await open(page(short, "short.html").url);
  assert.deepEqual(await texts(tab, "td.moss"), ["too short", "too short", "too short", "too short"]);
  assert.deepEqual(await texts(tab, "#list .like"), ["too short"]);
  await tab.close();
  writeFileSync(join(short, "port/a.comp"), "\n");
  const gone = await open(page(short, "short.html").url);
  assert.deepEqual(await texts(gone, "td.moss"), ["no target", "–"]);
  assert.deepEqual(gone.trouble, []);
  await gone.close();
});

test("a function of 20,000 lines opens in portions", async () => {
  const tab = await open(page(giant, "giant.html").url);
  await tab.click("#list .unit");
  await tab.waitForSelector("dialog[open] .code .row");
  const rows = await tab.locator("dialog .code .row").count();
  assert.ok(rows > 100 && rows < 2000, `${rows} rows at first`);
  await tab.click("dialog .fold");
  assert.ok(await tab.locator("dialog .code .row").count() > rows);
  assert.deepEqual(tab.trouble, []);
  await tab.close();
});

let failed = 0;
for (const { name, run } of tests) {
  const tab = run.length > 0 ? await open(own.url) : null;
  try {
    await run(tab);
    if (tab) assert.deepEqual(tab.trouble, []);
    console.log(`ok      ${name}`);
  } catch (error) {
    ++failed;
    console.log(`FAILED  ${name}\n${error.stack}`);
  }
  if (tab) await tab.close();
}
await browser.close();
rmSync(home, { recursive: true, force: true });
console.log(`${tests.length - failed} of ${tests.length} passed`);
process.exit(failed === 0 ? 0 : 1);
