// Every pair and unit as a tile: as large as it has lines, in the colour of its likeness, grouped by block.

const RAMP = {
  light: ["#cf7a2c", "#dfa463", "#e3d3ae", "#8cbcb3", "#12767a"],
  dark: ["#c97a35", "#8f6a41", "#4d5150", "#2f7a78", "#3da5a2"],
};

const MOST_TILES = 1200;
let printing = false;

// A colour between two, and whether black text reads better on it than white (relative luminance as WCAG defines it):
// above 0.179 it does, and there both have 4.58. A black any paler would have less than 4.5 around that.
function mixed(a, b, t) {
  const part = (text, i) => parseInt(text.slice(1 + 2 * i, 3 + 2 * i), 16);
  const channels = [0, 1, 2].map((i) => Math.round(part(a, i) + (part(b, i) - part(a, i)) * t));
  const [red, green, blue] = channels.map((c) => (c / 255 <= 0.04045 ? c / 255 / 12.92 : ((c / 255 + 0.055) / 1.055) ** 2.4));
  return { color: `rgb(${channels.join(" ")})`, light: 0.2126 * red + 0.7152 * green + 0.0722 * blue > 0.179 };
}

function colorOf(value) {
  const ramp = RAMP[printing ? "light" : document.documentElement.dataset.theme];
  const at = (Math.max(0, Math.min(100, value)) / 100) * (ramp.length - 1);
  const i = Math.min(ramp.length - 2, Math.floor(at));
  return mixed(ramp[i], ramp[i + 1], at - i);
}

// Squarified treemap (Bruls, Huizing, van Wijk 2000): rows of tiles as near to squares as they get.
function squarify(items, box) {
  const out = [];
  let { x, y, w, h: high } = box;
  let left = items.reduce((sum, item) => sum + item.size, 0);
  const queue = [...items].sort((a, b) => b.size - a.size);
  while (queue.length > 0 && left > 0 && w > 0 && high > 0) {
    const scale = (w * high) / left, side = Math.min(w, high);
    const row = [];
    let sum = 0, worst = Infinity;
    while (queue.length > 0) {
      const next = queue[0].size * scale, total = sum + next;
      const thick = total / side;
      const now = Math.max(...[...row, next].map((area) => Math.max(area / thick / thick, (thick * thick) / area)));
      if (row.length > 0 && now > worst) break;
      worst = now;
      sum = total;
      row.push(next);
      out.push({ item: queue.shift(), area: next });
    }
    const thick = sum / side;
    let along = 0;
    for (const placed of out.slice(-row.length)) {
      const length = placed.area / thick;
      Object.assign(placed, w >= high ? { x, y: y + along, w: thick, h: length } : { x: x + along, y, w: length, h: thick });
      along += length;
    }
    left -= row.reduce((total, area) => total + area / scale, 0);
    if (w >= high) { x += thick; w -= thick; } else { y += thick; high -= thick; }
  }
  return out;
}

const shownLikeness = (row) => (row.likeness === undefined ? null : row.likeness);

function tileOf(place) {
  const row = place.item.row, value = shownLikeness(row);
  const alone = !row.source || !row.target;
  const tone = alone ? null : colorOf(value === null ? 0 : value);
  const words = alone ? NAMES[row.share] : likeness(row) === null ? `${TOO_SHORT} for Moss, ${roughly(value)} by edits` : roughly(value);
  const label = `${rowName(row)}: ${words}, ${plural(rowLines(row), "line")}`;
  const fits = place.w > 46 && place.h > 17;
  const text = rowName(row);
  const room = Math.floor((place.w - 8) / 6.3);
  return s("g", { role: "link", tabindex: "-1", "data-key": row.key, "aria-label": label,
                  onclick: () => { location.hash = unitAddress(row); } },
    s("title", null, label),
    s("rect", { x: place.x, y: place.y, width: Math.max(0, place.w), height: Math.max(0, place.h), rx: 2,
                class: alone ? "alone" : null, fill: alone ? null : tone.color }),
    fits && s("text", { x: place.x + 5, y: place.y + 14, fill: alone ? "var(--muted)" : tone.light ? "#000000" : "#ffffff" },
      text.length > room ? text.slice(0, Math.max(1, room - 1)) + "…" : text));
}

function drawMap() {
  const holder = byId("treemap");
  const width = Math.max(280, Math.floor(holder.clientWidth));
  const tallest = width < 600 ? width * 1.25 : Math.min(560, width * 0.5);
  const height = Math.round(Math.min(tallest, 60 + 24 * report.units.length));
  const rows = report.units.filter((row) => rowLines(row) > 0).sort((a, b) => rowLines(b) - rowLines(a)).slice(0, MOST_TILES);
  const groups = new Map();
  for (const row of rows) {
    const name = row.block || "";
    if (!groups.has(name)) groups.set(name, []);
    groups.get(name).push({ size: rowLines(row), row });
  }
  const sized = [...groups].map(([name, items]) => ({ name, items, size: items.reduce((sum, item) => sum + item.size, 0) }));
  const tiles = squarify(sized, { x: 0, y: 0, w: width, h: height }).map((group) => {
    const head = sized.length > 1 && group.h > 40 && group.w > 60 ? 20 : 0;
    const gap = sized.length > 1 ? 3 : 0;
    return s("g", null,
      head > 0 && s("text", { class: "group", x: group.x + 2, y: group.y + 14 }, (group.item.name || "in no block").slice(0, Math.floor(group.w / 7.5))),
      squarify(group.item.items, { x: group.x, y: group.y + head, w: group.w - gap, h: group.h - head - gap }).map(tileOf));
  });
  const svg = s("svg", { class: "treemap", viewBox: `0 0 ${width} ${height}`, role: "group",
    "aria-label": "Map of all units; arrow keys move, Enter opens", onkeydown: moveInMap }, tiles);
  holder.replaceChildren(svg);
  const first = svg.querySelector("[data-key]");
  if (first) first.setAttribute("tabindex", "0");
}

// One tab stop for the whole map; the arrow keys go to the nearest tile in their direction.
function moveInMap(event) {
  const at = event.target.closest("[data-key]");
  if (!at) return;
  if (event.key === "Enter" || event.key === " ") {
    event.preventDefault();
    location.hash = unitAddress(rowsByKey.get(at.dataset.key));
    return;
  }
  const step = { ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, -1], ArrowDown: [0, 1] }[event.key];
  if (!step) return;
  event.preventDefault();
  const middle = (node) => { const box = node.querySelector("rect").getBoundingClientRect(); return [box.x + box.width / 2, box.y + box.height / 2]; };
  const [x, y] = middle(at);
  let best = null, least = Infinity;
  for (const other of byId("treemap").querySelectorAll("[data-key]")) {
    if (other === at) continue;
    const [ox, oy] = middle(other);
    const ahead = (ox - x) * step[0] + (oy - y) * step[1];
    const aside = Math.abs((ox - x) * step[1]) + Math.abs((oy - y) * step[0]);
    if (ahead > 1 && ahead + 2.5 * aside < least) { least = ahead + 2.5 * aside; best = other; }
  }
  if (!best) return;
  at.setAttribute("tabindex", "-1");
  best.setAttribute("tabindex", "0");
  best.focus();
}

function showMap() {
  put("map",
    h("h2", { id: "map-title" }, "Unit by unit"),
    h("p", { class: "about" }, "Each tile is a pair or a unit without counterpart, as large as it has lines on both sides. Open one to see both texts.",
      report.units.length > MOST_TILES && ` Drawn are the ${number(MOST_TILES)} largest of ${number(report.units.length)}.`),
    report.units.length === 0 ? h("p", { class: "empty" }, "No units on either side.") : [
      h("div", { id: "treemap" }),
      h("p", { class: "scale" }, h("span", null, "0 %", h("span", { class: "ramp", id: "ramp" }), "100 % alike"),
        h("span", null, h("span", { class: "swatch alone" }), "stands on one side only"))]);
}

function paintMap() {
  if (!byId("treemap")) return;
  drawMap();
  byId("ramp").style.background = `linear-gradient(90deg, ${RAMP[printing ? "light" : document.documentElement.dataset.theme].join(", ")})`;
}
