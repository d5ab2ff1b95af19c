// One pair side by side, one unit alone, or the lines of a block. Rows are drawn when the viewer opens, long equal
// stretches folded, long texts in portions.

const CONTEXT = 3, FOLD_FROM = 12, PORTION = 600;
let returnTo = null;

// The text of a line with its marks: first, length, 1 if only the spelling differs; for each.
function marked(text, marks) {
  if (!marks || marks.length === 0) return text || " ";
  const parts = [];
  let at = 0;
  for (let i = 0; i < marks.length; i += 3) {
    const first = Math.max(at, marks[i]), end = marks[i] + marks[i + 1];
    if (end <= first) continue;
    parts.push(text.slice(at, first), h("mark", { class: marks[i + 2] ? "translated" : null }, text.slice(first, end)));
    at = end;
  }
  parts.push(text.slice(at));
  return parts;
}

const differs = (marks) => (marks || []).some((value, i) => i % 3 === 2 && value === 0);
const isSame = (cells) => cells[0] > 0 && cells[1] > 0 && !differs(cells[2]) && !differs(cells[3]);

function pairRow(row, cells, shared) {
  const same = isSame(cells);
  const cell = (side, line, marks) => {
    if (line === 0) return [h("span", { class: "no none" }), h("span", { class: "text none" })];
    const tone = same ? "" : " changed";
    return [h("span", { class: `no${tone}${shared[side].has(line) ? " shared" : ""}`, title: `${row[side].file}:${line}` }, line),
            h("span", { class: `text${tone}` }, marked(linesOf(side, row[side].file)[line - 1] || "", marks))];
  };
  return h("div", { class: same ? "row same" : "row" }, cell("source", cells[0], cells[2]), cell("target", cells[1], cells[3]));
}

// Draws items in portions; what follows waits behind a button.
function inPortions(holder, items, draw, from = 0) {
  const end = Math.min(items.length, from + PORTION);
  for (let i = from; i < end; ++i) holder.append(draw(items[i]));
  if (end === items.length) return;
  const button = h("button", { type: "button", class: "fold" }, `Show the next of ${number(items.length - end)} more lines`);
  button.addEventListener("click", () => { button.remove(); inPortions(holder, items, draw, end); });
  holder.append(button);
}

// Rows with long equal stretches folded away, if anything differs at all.
function folded(rows) {
  if (!rows.some((cells) => !isSame(cells))) return rows;
  const out = [];
  for (let i = 0; i < rows.length;) {
    let end = i;
    while (end < rows.length && isSame(rows[end])) ++end;
    const head = i === 0 ? 0 : CONTEXT, tail = end === rows.length ? 0 : CONTEXT;
    if (end - i >= FOLD_FROM) {
      out.push(...rows.slice(i, i + head), { fold: rows.slice(i + head, end - tail) }, ...rows.slice(end - tail, end));
      i = end;
    } else {
      out.push(...rows.slice(i, Math.max(end, i + 1)));
      i = Math.max(end, i + 1);
    }
  }
  return out;
}

function pairBody(row) {
  const shared = { source: inSpans(row.source.shared), target: inSpans(row.target.shared) };
  const draw = (cells) => {
    if (!cells.fold) return pairRow(row, cells, shared);
    const button = h("button", { type: "button", class: "fold" }, `${plural(cells.fold.length, "equal line")}`);
    button.addEventListener("click", () => button.replaceWith(...cells.fold.map((one) => pairRow(row, one, shared))));
    return button;
  };
  const body = h("div", { class: "code double" }, h("div", { class: "row head" },
    ["source", "target"].map((side) => [h("span", { class: "no" }), h("span", { class: "text" }, `${side} · ${where(row[side])}`)])));
  inPortions(body, folded(row.rows), draw);
  return body;
}

function lineRow(side, file, line, isShared, isNovel) {
  return h("div", { class: isNovel ? "row novel" : "row" },
    h("span", { class: isShared ? "no shared" : "no", title: `${file}:${line}` }, line),
    h("span", { class: "text" }, linesOf(side, file)[line - 1] || " "));
}

function singleBody(row) {
  const side = row.source ? "source" : "target", unit = row[side];
  const lines = [];
  if (unit.kind === "file" && unit.name === "code outside units") lines.push(...inSpans(unit.code));
  else for (let line = unit.line; line <= unit.end_line; ++line) lines.push(line);
  const body = h("div", { class: "code single" }, h("div", { class: "file mono" }, where(unit)));
  inPortions(body, lines, (line) => lineRow(side, unit.file, line, false, false));
  return body;
}

function codeBody(files, side, only) {
  const body = h("div", { class: "code single" });
  const items = files.flatMap((file) => {
    const shared = inSpans(file.shared);
    const code = [...inSpans(file.code)].filter((line) => !only || (only === "shared") === shared.has(line));
    return code.length === 0 ? [] : [{ head: file.file }, ...code.map((line) => ({ file: file.file, line, shared: shared.has(line) }))];
  });
  if (items.length === 0) return h("p", { class: "empty", style: "margin:1.5rem" }, "No such lines.");
  inPortions(body, items, (item) => (item.head ? h("div", { class: "file mono" }, item.head)
    : lineRow(side, item.file, item.line, item.shared, !item.shared)));
  return body;
}

function closeViewer() {
  byId("viewer").close();
}

function headButtons(...more) {
  return h("div", { class: "buttons" }, more,
    h("button", { type: "button", class: "quiet", id: "close", onclick: closeViewer, "aria-label": "Close" }, "Close"));
}

const HOW_SHARED = () => h("a", { href: "#how-shared" }, "how Moss % is computed");
const SWATCH = (style, text) => h("span", null, h("i", { style }), text);

function neighbour(row, step) {
  const rows = matchingRows();
  const at = rows.indexOf(row);
  return at < 0 ? null : rows[at + step] || null;
}

function unitHead(row) {
  const both = row.source && row.target;
  const findings = report.drift.findings.filter((finding) => rowOfFinding(finding) === row);
  const facts = [];
  if (both) {
    const value = likeness(row);
    facts.push(value === null ? `${capital(TOO_SHORT)} for Moss; ${roughly(row.likeness)} alike by edits`
      : `Moss ${percent(row.moss_percent_source)} of the source, ${percent(row.moss_percent_target)} of the target`);
    if (value !== null) facts.push(`names folded ${percent(row.moss_percent_blind_target)}, as written ${percent(row.moss_percent_raw_target)} of the target`);
  }
  facts.push(`${[row.source, row.target].filter(Boolean).map((side) => number(side.lines)).join(" and ")} ${rowLines(row) === 1 ? "line" : "lines"} of code`);
  if (row.block) facts.push(row.block);
  const step = (name, by, key) => {
    const to = neighbour(row, by);
    return h("button", { type: "button", class: "quiet", disabled: !to, "aria-keyshortcuts": key, onclick: () => { if (to) location.replace(unitAddress(to)); } }, name);
  };
  return h("div", { class: "viewer-head" },
    h("div", { class: "line" }, h("h2", { id: "viewer-title" }, rowName(row)), tag(row.share), row.state && tag(row.state),
      headButtons(step("←", -1, "ArrowLeft"), step("→", 1, "ArrowRight"))),
    h("p", { class: "facts" }, facts.join(" · "), both && [" · ", HOW_SHARED()]),
    row.reason && h("p", { class: "facts" }, "“", row.reason, "”"),
    findings.map((finding) => h("p", { class: `finding ${finding.level}` }, h("b", null, finding.rule), " ", finding.message)),
    both && h("div", { class: "key" }, SWATCH("background:var(--twin);width:.25rem", "shared line"),
      SWATCH("background:var(--mark)", "differs"), SWATCH("background:var(--mark-soft)", "same in another spelling")));
}

function openViewer(head, body) {
  const dialog = byId("viewer");
  if (!dialog.open) returnTo = document.activeElement;
  dialog.replaceChildren(head, h("div", { class: "viewer-body", tabindex: "0" }, body),
    h("p", { class: "keys" }, h("kbd", null, "Esc"), " closes", head.querySelector("[aria-keyshortcuts]") &&
      [", ", h("kbd", null, "←"), " ", h("kbd", null, "→"), " go to the neighbours in the list"]));
  if (!dialog.open) dialog.showModal();
  dialog.querySelector(".viewer-body").focus();
}

function openUnit(key) {
  const row = rowsByKey.get(key);
  if (!row) return false;
  openViewer(unitHead(row), row.source && row.target ? pairBody(row) : singleBody(row));
  return true;
}

function openCode(values) {
  const side = values.side === "target" ? "target" : "source";
  const block = values.block ? blocksByName.get(values.block) : report.totals;
  if (!block) return false;
  const tab = (only, text) => h("a", { class: "quiet tab", "aria-current": (values.only || "") === only ? "true" : null,
    href: linesAddress(values.block, side, only) }, text);
  const lines = block[`${side}_lines`], shared = block[`shared_${side}`];
  openViewer(h("div", { class: "viewer-head" },
    h("div", { class: "line" }, h("h2", { id: "viewer-title" }, `${values.block || "All lines"}, ${side}`), headButtons()),
    h("p", { class: "facts" }, shared === null ? `${plural(lines, "line")} of code, ${TOO_SHORT} to be measured`
      : `${plural(lines, "line")} of code, ${number(shared)} shared, ${number(lines - shared)} novel · Moss ${percent(block[`moss_percent_${side}`], lines, otherSide(block, side))}`, " · ", HOW_SHARED()),
    h("div", { class: "line" }, tab("", "All"), tab("shared", "Shared"), tab("novel", "Novel"))),
    codeBody(block.lines[side], side, values.only));
  return true;
}
