// The report as porttool wrote it, and ways into it. Addresses after # name what is shown, so that they can be sent on.

// How it is packed: portability_page.cpp.
async function unpacked(text) {
  const bytes = Uint8Array.from(atob(text), (character) => character.charCodeAt(0));
  const stream = new Blob([bytes]).stream().pipeThrough(new DecompressionStream("deflate"));
  return JSON.parse(await new Response(stream).text());
}

// Steps from one span to the next as [first, last] pairs.
function spansOf(steps) {
  const spans = [];
  for (let i = 0, at = 0; i < steps.length; i += 2) {
    const first = at + steps[i];
    at = first + steps[i + 1];
    spans.push([first, at]);
  }
  return spans;
}

function unpackLines(report, side) {
  const code = new Map();
  for (const file of report.totals.lines[side]) {
    Object.assign(file, { code: spansOf(file.code), shared: spansOf(file.shared) });
    code.set(file.file, file.code);
  }
  for (const block of report.blocks)
    for (const file of block.lines[side])
      Object.assign(file, { code: file.code ? spansOf(file.code) : code.get(file.file), shared: spansOf(file.shared) });
  for (const unit of report.units.map((row) => row[side]).filter(Boolean)) {
    unit.shared = spansOf(unit.shared);
    if (unit.code) unit.code = spansOf(unit.code);
  }
}

function unpackRows(rows) {
  const last = [0, 0];
  for (const cells of rows)
    for (const side of [0, 1])
      if (cells[side] > 0) cells[side] = last[side] += cells[side];
}

async function readReport() {
  const report = await unpacked(byId("data").textContent);
  for (const side of ["source", "target"]) unpackLines(report, side);
  for (const row of report.units) unpackRows(row.rows || []);
  return report;
}

const report = await readReport();
const rowsByKey = new Map(report.units.map((row) => [row.key, row]));
const blocksByName = new Map(report.blocks.map((block) => [block.name, block]));

function address(place, values) {
  const query = new URLSearchParams(Object.entries(values).filter(([, value]) => value));
  return `#${place}?${query}`;
}

function parseAddress(hash) {
  const text = hash.replace(/^#/, "");
  const cut = text.indexOf("?");
  return cut < 0 ? { place: text, values: {} }
                 : { place: text.slice(0, cut), values: Object.fromEntries(new URLSearchParams(text.slice(cut + 1))) };
}

const unitAddress = (row) => address("unit", { key: row.key });
const linesAddress = (block, side, only) => address("code", { block, side, only });
const listAddress = (values) => address("units", values);

// A name without its namespaces: the last part, and its class if it is a method.
function lastName(name) {
  const parts = name.split("::");
  const owner = parts.length > 1 && /^[A-Z]/.test(parts[parts.length - 2]) ? parts[parts.length - 2] + "::" : "";
  return owner + parts[parts.length - 1];
}

function rowName(row) {
  const names = [row.source, row.target].filter(Boolean).map((side) => lastName(side.name));
  return names.length === 2 && names[0] !== names[1] ? names.join(" → ") : names[0];
}

const rowLines = (row) => (row.source ? row.source.lines : 0) + (row.target ? row.target.lines : 0);
const where = (side) => `${side.file}:${side.line}`;

// The likeness of a row in percent, or null where it is too short or stands alone: the lesser of its two sides.
function likeness(row) {
  if (!row.source || !row.target || row.moss_percent_source === null || row.moss_percent_target === null) return null;
  return Math.min(row.moss_percent_source, row.moss_percent_target);
}

const textLines = new Map();
function linesOf(side, file) {
  const key = side + "\n" + file;
  if (!textLines.has(key)) textLines.set(key, (report.texts[side][file] || "").split("\n"));
  return textLines.get(key);
}

const inSpans = (spans) => {
  const set = new Set();
  for (const [first, last] of spans || []) for (let line = first; line <= last; ++line) set.add(line);
  return set;
};
