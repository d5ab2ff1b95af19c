// All units as a list that can be searched and filtered. What is chosen stands in the address.

const PAGE = 250;
let shown = PAGE;
const chosen = { q: "", block: "", state: "", kind: "", sort: "" };

const searchText = new Map(report.units.map((row) => [row.key, [row.source, row.target].filter(Boolean)
  .map((side) => `${side.id} ${side.name}`).join(" ").toLowerCase()]));

const SORTS = {
  "": ["file and line", () => 0],
  likeness: ["least alike first", (a, b) => (shownLikeness(a) ?? 101) - (shownLikeness(b) ?? 101)],
  lines: ["most lines first", (a, b) => rowLines(b) - rowLines(a)],
};

function matchingRows() {
  const words = chosen.q.toLowerCase().split(/\s+/).filter(Boolean);
  const rows = report.units.filter((row) =>
    words.every((word) => searchText.get(row.key).includes(word)) &&
    (!chosen.block || (chosen.block === "-" ? row.blocks.length === 0 : row.blocks.includes(chosen.block))) &&
    (!chosen.state || row.state === chosen.state) && (!chosen.kind || row.share === chosen.kind));
  return chosen.sort ? [...rows].sort(SORTS[chosen.sort][1]) : rows;
}

function likenessCell(row) {
  if (!row.source || !row.target) return h("span", { class: "like faint" }, row.source ? "source only" : "target only");
  const value = likeness(row);
  if (value === null) return h("span", { class: "like" }, h("span", { class: "short" }, TOO_SHORT));
  return h("span", { class: "like" }, bar(value), roughly(value));
}

function unitItem(row) {
  const sides = [row.source, row.target].filter(Boolean);
  return h("li", null, h("a", { class: "unit", href: unitAddress(row), "data-key": row.key },
    h("span", null, h("span", { class: "name" }, rowName(row)), h("span", { class: "files" }, sides.map(where).join("  →  "))),
    h("span", { class: "size" }, sides.map((side) => number(side.lines)).join(" → "), rowLines(row) === 1 ? " line" : " lines"),
    likenessCell(row),
    h("span", { class: "tags" }, tag(row.share), row.state && row.state !== "in_step" && tag(row.state))));
}

function refreshList() {
  const rows = matchingRows();
  const lines = rows.reduce((sum, row) => sum + rowLines(row), 0);
  byId("total").textContent = `${plural(rows.length, "unit")}, ${plural(lines, "line")}`;
  byId("list").replaceChildren(...(rows.length > 0 ? rows.slice(0, shown).map(unitItem)
    : [h("li", null, h("p", { class: "empty", style: "border:0;margin:0" }, "Nothing matches. ", h("a", { href: listAddress({}) }, "Show all units")))]));
  byId("more").hidden = rows.length <= shown;
  byId("more").textContent = `Show ${number(Math.min(PAGE, rows.length - shown))} more of ${number(rows.length)}`;
}

// Takes what the address chose into the controls and the list.
function choose(values) {
  for (const name of Object.keys(chosen)) {
    chosen[name] = values[name] || "";
    byId(`choose-${name}`).value = chosen[name];
  }
  shown = PAGE;
  refreshList();
}

function control(name, label, options) {
  const change = (event) => {
    chosen[name] = event.target.value;
    history.replaceState(null, "", listAddress(chosen));
    shown = PAGE;
    refreshList();
  };
  return options
    ? h("label", null, label, h("select", { id: `choose-${name}`, onchange: change }, options.map(([value, text]) => h("option", { value }, text))))
    : h("label", { class: "grow" }, label, h("input", { id: `choose-${name}`, type: "search", autocomplete: "off", spellcheck: "false",
        placeholder: "a name or a path", "aria-keyshortcuts": "/", oninput: change, onkeydown: openFirst }));
}

// Enter in the search field opens the first match, down goes to it.
function openFirst(event) {
  const first = byId("list").querySelector("a.unit");
  if (!first || event.isComposing || (event.key !== "Enter" && event.key !== "ArrowDown")) return;
  event.preventDefault();
  first.focus();
  if (event.key === "Enter") first.click();
}

// Up and down move through the list, as in any list.
function moveInList(event) {
  if (event.key !== "ArrowDown" && event.key !== "ArrowUp") return;
  const item = event.target.closest("li");
  const next = item && (event.key === "ArrowDown" ? item.nextElementSibling : item.previousElementSibling);
  if (!next) return;
  event.preventDefault();
  next.querySelector("a").focus();
}

function showUnits() {
  const all = (name) => ["", name];
  put("units",
    h("h2", { id: "units-title" }, "Pairs and units"),
    h("p", { class: "about" }, "Every pair side by side, and every unit without a counterpart. ", h("kbd", null, "/"), " searches, ",
      h("kbd", null, "Enter"), " opens, ", h("kbd", null, "Esc"), " closes."),
    h("div", { class: "tools", role: "search" },
      control("q", "Search"),
      control("block", "Block", [all("all"), ...report.blocks.map((block) => [block.name, block.name]), ["-", "in no block"]]),
      control("state", "State", [all("any"), ...STATES.map((state) => [state, NAMES[state]])]),
      control("kind", "Kind", [all("any"), ...KINDS.map((kind) => [kind, NAMES[kind]])]),
      control("sort", "Order", Object.entries(SORTS).map(([value, [text]]) => [value, text])),
      h("span", { class: "total", id: "total", role: "status" })),
    h("ul", { class: "list", id: "list", onkeydown: moveInList }),
    h("button", { type: "button", class: "quiet more", id: "more", onclick: () => { shown += PAGE; refreshList(); } }));
  refreshList();
}
