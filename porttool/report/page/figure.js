// Both cores side by side: each block as high as it has lines, its shared part towards the middle and tied to the shared
// part of the other side. A line that lies in several blocks is drawn in the smallest of them.

function stack(items, side, height, total, gap) {
  const scale = (height - gap * Math.max(0, items.length - 1)) / Math.max(1, total);
  let top = 0;
  return items.map((item) => {
    const lines = item[`${side}_lines`];
    const high = lines * scale;
    const place = { top, high, lines, shared: item[`${side}_shared`] };
    top += high + (lines > 0 ? gap : 0);
    return place;
  });
}

const HUES = 6;

const MOST_PARTS = 12;

// The parts to draw, in the order of the blocks; where they are many, the smaller ones as one.
function partsToDraw() {
  const lines = (item) => item.source_lines + item.target_lines;
  const items = report.own_blocks.filter((item) => lines(item) > 0);
  if (items.length <= MOST_PARTS) return items;
  const large = new Set([...items].sort((a, b) => lines(b) - lines(a)).slice(0, MOST_PARTS - 1));
  const small = items.filter((item) => !large.has(item));
  const sum = (field) => small.reduce((total, item) => total + (item[field] || 0), 0);
  const rest = { name: null, label: `${number(small.length)} smaller`, href: "#blocks" };
  for (const field of ["source_lines", "source_shared", "target_lines", "target_shared"]) rest[field] = sum(field);
  return [...items.filter((item) => large.has(item)), rest];
}

// A block that holds others shows what is left of it.
function partName(item) {
  if (item.name === null) return item.label || "in no block";
  const block = blocksByName.get(item.name);
  const whole = block.source_lines + block.target_lines, own = item.source_lines + item.target_lines;
  return own < whole ? `${item.name}, rest` : item.name;
}

// For places with little room: of SOURCE=TARGET the source file's name, with the end of its stem.
function shortPartName(item) {
  const name = partName(item), room = 23;
  if (name.length <= room) return name;
  const file = name.split("=")[0];
  return file.length <= room ? file : `…${file.slice(1 - room)}`;
}

// How much is shared, in words; null stands for a block too short to tell.
const sharedWords = (lines, shared) =>
  `${plural(lines, "line")}, ${shared === null ? TOO_SHORT : `${number(shared)} shared, ${number(lines - shared)} novel`}`;

function drawCores(items) {
  const width = 1120, column = 270, left = 190, middle = width - 2 * column - 2 * left, gap = 6;
  const totals = { source: 0, target: 0 };
  for (const item of items) for (const side of ["source", "target"]) totals[side] += item[`${side}_lines`];
  const most = Math.max(totals.source, totals.target, 1);
  const height = Math.max(260, Math.min(460, 60 * items.length + 120));
  const spare = gap * (items.length - 1);
  const high = (side) => (height - spare) * (totals[side] / most) + spare;
  const places = { source: stack(items, "source", high("source"), totals.source, gap),
                   target: stack(items, "target", high("target"), totals.target, gap) };
  const right = left + column + middle;
  const parts = items.map((item, i) => {
    const a = places.source[i], b = places.target[i];
    const shareA = a.lines ? a.shared / a.lines : 0, shareB = b.lines ? b.shared / b.lines : 0;
    const hue = item.name === null ? "other" : `hue${i % HUES}`;
    const name = partName(item);
    const box = (place, share, x, toRight, side) => {
      if (place.lines === 0) return null;
      const sharedWidth = column * share;
      const sharedX = toRight ? x + column - sharedWidth : x;
      const novelX = toRight ? x : x + sharedWidth;
      const href = item.href || (item.name === null ? listAddress({ block: "-" }) : linesAddress(item.name, side, ""));
      const words = `${name}, ${side}: ${sharedWords(place.lines, place.shared)}`;
      return s("a", { href, "aria-label": words },
        s("title", null, words),
        s("rect", { class: place.shared === null ? "short" : "novel", x: novelX, y: place.top, width: column - sharedWidth, height: place.high }),
        s("rect", { class: "shared", x: sharedX, y: place.top, width: sharedWidth, height: place.high }),
        place.high >= 13 && [
          s("text", { class: "count", x: toRight ? x - 12 : x + column + 12, y: place.top + place.high / 2 + 4,
                      "text-anchor": toRight ? "end" : "start" }, `${shortPartName(item)}  `, s("tspan", { class: "faint" }, number(place.lines)))]);
    };
    const tie = a.lines && b.lines && (shareA > 0 || shareB > 0) && s("path", { class: "tie", d:
      `M${left + column} ${a.top}C${left + column + middle / 2} ${a.top} ${right - middle / 2} ${b.top} ${right} ${b.top}` +
      `V${b.top + b.high}C${right - middle / 2} ${b.top + b.high} ${left + column + middle / 2} ${a.top + a.high} ${left + column} ${a.top + a.high}Z` });
    return s("g", { class: hue }, tie, box(a, shareA, left, true, "source"), box(b, shareB, right, false, "target"));
  });
  return s("svg", { class: "cores", viewBox: `0 -34 ${width} ${height + 40}`, role: "group",
                    "aria-label": "Both sides by block, shared and novel lines" },
    s("text", { class: "side", x: left + column, y: -14, "text-anchor": "end" }, `Source · ${plural(totals.source, "line")}`),
    s("text", { class: "side", x: right, y: -14 }, `Target · ${plural(totals.target, "line")}`),
    parts);
}

// The same in the shape that a narrow page needs: one bar a block and side.
function listCores(items) {
  return h("ul", { class: "cores-list" }, items.map((item, i) => h("li", { class: item.name === null ? "other" : `hue${i % HUES}` },
    h("b", null, partName(item)),
    ["source", "target"].map((side) => {
      const lines = item[`${side}_lines`], shared = item[`${side}_shared`];
      const most = Math.max(1, ...items.flatMap((one) => [one.source_lines, one.target_lines]));
      return h("div", { class: "pairbar" }, h("span", { class: "side-name" }, side),
        h("span", { class: "track" }, h("span", { class: "shared", style: `width:${(100 * shared) / most}%` }),
          h("span", { class: shared === null ? "short" : "novel", style: `width:${(100 * (lines - shared)) / most}%`,
                      title: shared === null ? TOO_SHORT : null })),
        h("span", { class: "faint" }, number(lines)));
    }))));
}

function fate(side) {
  const parts = report.totals.decomposition[side];
  const kinds = KINDS.filter((kind) => parts[kind] > 0);
  return h("div", { class: "fate" },
    h("h3", null, capital(side), " ", h("span", { class: "faint" }, plural(parts.total, "line"))),
    parts.total === 0 ? h("p", { class: "empty" }, "No code on this side.") : [
      h("div", { class: "fatebar", "aria-hidden": "true" }, kinds.map((kind) =>
        h("span", { class: `part ${kind}`, style: `flex-grow:${parts[kind]}`, title: `${NAMES[kind]}: ${number(parts[kind])}` }))),
      h("ul", { class: "legend" }, KINDS.map((kind) => h("li", null, h("a", { href: listAddress({ kind }) },
        h("span", { class: `swatch ${kind}`, "aria-hidden": "true" }), NAMES[kind], " ",
        h("b", null, number(parts[kind])), " ",
        h("span", { class: "faint" }, `${((100 * parts[kind]) / parts.total).toFixed(0)} %`)))))]);
}

function showLines() {
  const items = partsToDraw();
  put("lines",
    h("h2", { id: "lines-title" }, "Where the lines are"),
    h("p", { class: "about" }, "Both sides by functional block, to one scale. The full colour towards the middle is shared, the pale part is novel; what is too short to be measured is only outlined. ",
      "A line in several blocks is drawn in the smallest."),
    items.length === 0 ? h("p", { class: "empty" }, "No code on either side.") : [
      h("div", { class: "wide" }, drawCores(items)), h("div", { class: "narrow" }, listCores(items))],
    h("h3", { class: "apart" }, h("a", { href: "#how-parts" }, "What became of each line")),
    h("div", { class: "fates" }, fate("source"), fate("target")));
}
