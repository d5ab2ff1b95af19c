// The report as porttool wrote it, and ways into it. Addresses after # name what is shown, so that they can be sent on.

const report = JSON.parse(byId("data").textContent);
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
