// The verdict, the figures that a lead asks for first, and the thesis's Table 2.

const VERDICTS = {
  in_step: ["In step", "No port is behind what was recorded of its source."],
  review: ["To review", "Nothing drifted for certain, but somebody should look."],
  drift: ["Drifted", "Some ports no longer say what their sources say."],
};

const NOT_RECORDED = "There is no portmap.lock yet; porttool init records the present state of the pairs.";

function tile(label, value, note, href) {
  const inside = [h("span", { class: "label" }, label), h("span", { class: "value" }, value), h("span", { class: "note" }, note)];
  return href ? h("a", { class: "tile", href }, inside) : h("div", { class: "tile" }, inside);
}

const range = (dp) => (dp.low === dp.high ? "" : `${degree(dp.low)} to ${degree(dp.high)}`);

function showSummary() {
  const { drift, totals, base } = report;
  const [title, sentence] = VERDICTS[drift.verdict] || ["Nothing recorded", NOT_RECORDED];
  const count = drift.summary || { pairs: 0, in_step: 0, drifted: 0, review: 0, deferred: 0, ignored: 0 };
  const rest = [["drifted", count.drifted], ["review", count.review], ["deferred", count.deferred], ["ignored", count.ignored]]
    .filter(([, n]) => n > 0).map(([name, n]) => `${number(n)} ${NAMES[name]}`);
  const fresh = openFindings().filter(({ rule }) => rule === "unported" || rule === "unpaired").length;
  if (fresh > 0) rest.push(`${plural(fresh, "new unit")} in no pair`);
  const dp = totals.degree_of_portability;
  const since = (side) => (totals.change ? [" ", change(totals.change[side], 0, 0)] : []);
  put("summary",
    h("p", { class: "kicker" }, "Source ", h("code", null, report.sides.source.join(", ")), " and target ",
      h("code", null, report.sides.target.join(", "))),
    h("h1", { id: "verdict", class: drift.verdict || "none" }, h("span", { class: "dot", "aria-hidden": "true" }), title),
    h("p", { class: "lead" }, count.pairs === 0 && drift.verdict !== null ? "No units are paired yet." : sentence, " ",
      count.pairs > 0 && h("a", { href: listAddress({ state: "in_step" }) },
        `${number(count.in_step)} of ${plural(count.pairs, "pair")} in step`),
      rest.length > 0 ? `, ${rest.join(", ")}.` : count.pairs > 0 ? "." : ""),
    base && h("p", { class: "since" }, "Changes are against the merge base with ", h("code", null, base.revision), "."),
    h("div", { class: "tiles" },
      tile("Lines, source and target", [number(totals.source_lines), since("source_lines"), h("i", null, " / "),
        number(totals.target_lines), since("target_lines")], "that hold code", "#lines"),
      tile("Shared, of the target", [percent(totals.moss_percent_target, totals.target_lines, otherSide(totals, "target")), " ",
        totals.change && change(totals.change.moss_percent_target, 1, 1)],
        totals.moss_percent_target === null ? "needs code on both sides" : `Moss %; ${percent(totals.moss_percent_source)} of the source`,
        linesAddress("", "target", "shared")),
      tile("Degree of portability", [dp ? degree(dp.loc) : "–", " ",
        totals.change && change(totals.change.degree_of_portability, 2, 1)],
        dp ? [range(dp), range(dp) && ", ", `by ${dp.model}`] : "needs code on both sides", "#blocks"),
      tile("Open findings", [drift.verdict === null ? "–" : number(openFindings().length)],
        drift.verdict === null ? "nothing recorded" : `${plural(count.deferred, "pair")} deferred, ${number(count.ignored)} ignored`, "#ledger")));
}

const openFindings = () => report.drift.findings.filter((finding) => finding.status === "open");

const bar = (value) => h("span", { class: "bar" }, h("span", { style: `width:${Math.max(0, Math.min(100, value))}%` }));

function otherSide(block, side) {
  const other = side === "source" ? "target" : "source";
  return { side: other, lines: block[`${other}_lines`] };
}

function sideCells(block, side) {
  const delta = block.change || {};
  const link = (only, text, label) => h("a", { href: linesAddress(block.isTotal ? "" : block.name, side, only), "aria-label":
    `${block.name}, ${side}, ${label}: show these lines` }, text);
  return [
    h("td", { class: "n", "data-label": `${side} lines` }, link("", number(block[`${side}_lines`]), "lines"),
      change(delta[`${side}_lines`], 0, 0)),
    h("td", { class: "n", "data-label": `${side} shared` }, link("shared", block[`shared_${side}`] === null ? "–" : number(block[`shared_${side}`]), "shared lines"),
      change(delta[`shared_${side}`], 0, 0)),
    h("td", { class: "n moss", "data-label": `${side} Moss` }, h("span", { class: "figure" }, percent(block[`moss_percent_${side}`], block[`${side}_lines`], otherSide(block, side))),
      change(delta[`moss_percent_${side}`], 1, 1), block[`moss_percent_${side}`] !== null && bar(block[`moss_percent_${side}`])),
  ];
}

function blockRow(block) {
  const dp = block.degree_of_portability;
  return h("tr", { class: block.isTotal ? "total" : null, "data-block": block.name },
    h("th", { scope: "row" }, block.isTotal ? block.name : h("a", { href: listAddress({ block: block.name }) }, block.name)),
    sideCells(block, "source"), sideCells(block, "target"),
    h("td", { class: "n dp", "data-label": "portability" }, dp ? h("span", { class: "figure", title: dp.model }, degree(dp.loc)) : "–",
      change((block.change || {}).degree_of_portability, 2, 1),
      dp && range(dp) && h("small", null, range(dp))));
}

const IN_PORT = {
  twin: "twin", equivalent: "equivalent", recorded: "recorded", absent: "absent", left_out: "left out",
};

// Units by port, where the map names several.
function showTargets() {
  if (!report.matrix) return;
  byId("targets").hidden = false;
  const cell = ({ state, target, edits }) => {
    const words = state === "behind" ? `behind by ${plural(edits, "edit")}` : IN_PORT[state];
    return h("td", target ? { title: target } : null, words);
  };
  put("targets",
    h("h2", { id: "targets-title" }, "Targets"),
    h("p", { class: "about" }, "What each port has of each source unit."),
    h("div", { class: "scroll", tabindex: "0", role: "region", "aria-label": "Targets, table" },
      h("table", null,
        h("thead", null, h("tr", null, h("th", { scope: "col" }, "Unit"),
          report.matrix.targets.map((name) => h("th", { scope: "col" }, name)))),
        h("tbody", null, report.matrix.units.map((unit) =>
          h("tr", null, h("th", { scope: "row" }, h("code", null, unit.source)), unit.cells.map(cell)))))));
}

// How much of each platform's speed the program reaches, where bench files were given.
function showSpeed() {
  if (!report.performance) return;
  const { platforms, performance_portability: portability } = report.performance;
  const rate = (value) => (value === null ? "not known" : value.toFixed(2));
  byId("speed").hidden = false;
  put("speed",
    h("h2", { id: "speed-title" }, "Speed"),
    h("p", { class: "about" }, "How much of what each platform can do the program reaches, and the harmonic mean of that (Pennycook, Sewall and Lee)."),
    h("div", { class: "scroll", tabindex: "0", role: "region", "aria-label": "Speed, table" },
      h("table", { class: "speed" },
        h("thead", null, h("tr", null, h("th", { scope: "col" }, "Platform"),
          ["Mrays/s", "of at most", "Efficiency"].map((name) => h("th", { scope: "col", class: "n" }, name)))),
        h("tbody", null, platforms.map((platform) => h("tr", null, h("th", { scope: "row" }, platform.name),
          h("td", { class: "n" }, rate(platform.achieved_mrays_per_s)), h("td", { class: "n" }, rate(platform.limit_mrays_per_s)),
          h("td", { class: "n" }, rate(platform.efficiency))))))),
    h("p", { class: "fine" }, `Performance portability: ${portability === null ? "not known, for want of a limit" : degree(portability)}.`));
}

function showBlocks() {
  const total = { ...report.totals, name: "All lines", isTotal: true };
  const group = (text, span) => h("th", { colspan: span, scope: "colgroup" }, text);
  const how = (place, text) => h("a", { href: `#how-${place}`, title: "how this is computed" }, text);
  const heads = () => [how("lines", "Lines"), how("shared", "Shared"), how("shared", "Moss %")].map((name) => h("th", { scope: "col", class: "n" }, name));
  const dp = [...report.blocks, total].map((block) => block.degree_of_portability).find(Boolean);
  put("blocks",
    h("h2", { id: "blocks-title" }, "Blocks"),
    h("p", { class: "about" }, report.blocks.length === 0
      ? "No functional blocks: portmap.toml names none, and no files are paired. The last row holds both sides as a whole."
      : report.blocks_are_file_pairs
        ? "portmap.toml names no functional blocks, so each pair of files is one. Every number leads to its lines."
        : "The functional blocks of portmap.toml; one may lie within another. Every number leads to its lines."),
    h("div", { class: "scroll", tabindex: "0", role: "region", "aria-label": "Blocks, table" },
      h("table", { class: "blocks" },
        h("thead", null,
          h("tr", null, h("td"), group("Source", 3), group("Target", 3), h("td")),
          h("tr", null, h("th", { scope: "col" }, "Block"), heads(), heads(),
            h("th", { scope: "col", class: "n", title: "Degree of portability" }, how("degree", "DP")))),
        h("tbody", null, report.blocks.map(blockRow), blockRow(total)))),
    dp && h("p", { class: "fine" }, `DP: degree of portability, model “${dp.model}”, with the interval from the strictest to the loosest reading of what is shared.`));
}
