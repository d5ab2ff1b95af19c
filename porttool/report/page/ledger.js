// What is open, what was postponed, and what was settled, with how long it has stood.

const days = (count) => plural(count, "day");

function ageOf(entry) {
  if (entry.status === "deferred" || (entry.days_left !== null && entry.days_left < 0)) {
    const left = entry.days_left === null ? null : entry.days_left < 0 ? `expired ${days(-entry.days_left)} ago` : `${days(entry.days_left)} left`;
    return h("div", { class: "age" }, left || "", h("small", null, [entry.until && `until ${entry.until}`, entry.owner].filter(Boolean).join(", ")));
  }
  if (entry.age_days === null) return h("div", { class: "age" });
  const text = entry.age_days === 0 ? "today" : `${entry.age_is_least ? "at least " : ""}${days(entry.age_days)}`;
  return h("div", { class: "age" }, text, h("small", null, entry.age_days === 0 ? "or not committed yet" : "since the commit that brought it in"));
}

function rowOfFinding(finding) {
  if (rowsByKey.has(finding.pair)) return rowsByKey.get(finding.pair);
  const ids = [finding.source && finding.source.id, finding.target && finding.target.id].filter(Boolean);
  return rowsByKey.get(ids.join("=")) || rowsByKey.get(ids[0]) || null;
}

function placeLine(finding) {
  const row = rowOfFinding(finding);
  const places = ["source", "target"].map((side) => finding[side] && `${finding[side].file}:${finding[side].line}`).filter(Boolean);
  const text = places.join(" → ") || finding.pair;
  return h("p", { class: "ids" }, row ? h("a", { href: unitAddress(row) }, h("code", null, text)) : h("code", null, text));
}

function entryItem(finding) {
  return h("li", null,
    h("div", { class: "what" },
      h("p", null, h("span", { class: `tag ${finding.status === "open" ? finding.level : ""}` }, finding.status === "open" ? finding.level : finding.status), " ",
        h("b", null, finding.rule), " ", finding.message),
      placeLine(finding),
      finding.reason && h("p", { class: "faint" }, "“", finding.reason, "”"),
      finding.status === "open" && h("p", { class: "fine" }, finding.remedy)),
    ageOf(finding));
}

function acceptedItem(entry) {
  const row = rowsByKey.get(`${entry.source}=${entry.target}`);
  const text = h("code", null, `${entry.source} → ${entry.target}`);
  return h("li", null,
    h("div", { class: "what" }, h("p", { class: "ids" }, row ? h("a", { href: unitAddress(row) }, text) : text),
      h("p", { class: "faint" }, "“", entry.reason, "”")),
    h("div", { class: "age" }, entry.age_days === null ? "" : `${days(entry.age_days)} ago`, h("small", null, entry.date)));
}

function showLedger() {
  const { findings, accepted, as_of: asOf } = report.drift;
  const of = (status) => findings.filter((finding) => finding.status === status);
  const list = (title, items, draw) => items.length > 0 && [h("h3", null, title, " ", h("span", { class: "faint" }, number(items.length))),
    h("ul", { class: "entries" }, items.map(draw))];
  const open = of("open");
  put("ledger",
    h("h2", { id: "ledger-title" }, "Drift ledger"),
    h("p", { class: "about" }, "What one side got and the other did not, and what was said about it. Ages as of ", h("span", { class: "n" }, asOf), "."),
    report.drift.verdict === null ? h("p", { class: "empty" }, NOT_RECORDED)
      : open.length === 0 && h("div", { class: "allwell" }, h("span", { class: "ring", "aria-hidden": "true" }, "✓"),
      h("p", null, h("b", null, "Nothing drifted. "), report.drift.summary.pairs === 0 ? "There are no pairs yet that could." : "Every change since the last record reached both sides, or somebody has answered for it.")),
    open.length === 0 && findings.length + accepted.length > 0 && h("p"),
    list("Open", open, entryItem), list("Deferred", of("deferred"), entryItem), list("Ignored", of("ignored"), entryItem),
    list("Accepted with a reason", accepted, acceptedItem));
}
