// Elements and numbers. Text always goes in as text nodes, so that no source line is ever read as markup, and what
// would reorder or hide it is shown as an escape, as in porttool's other outputs. Joiners and variation selectors stay
// within emoji.

const INVISIBLE = /[\x00-\x08\x0B-\x1F\x7F-\x9F\p{Default_Ignorable_Code_Point}\u2028\u2029\uFFF9-\uFFFB]/gu;
const AFTER_PICTURE = /(?:\p{Extended_Pictographic}|\p{Emoji_Modifier}|\uFE0F)$/u;

function visible(text) {
  return String(text).replace(INVISIBLE, (character, at, all) => {
    const isPart = (character === "\uFE0F" || character === "\u200D") && AFTER_PICTURE.test(all.slice(Math.max(0, at - 2), at));
    return isPart ? character : `\\u{${character.codePointAt(0).toString(16)}}`;
  });
}

const SHOWN = new Set(["title", "aria-label"]);  // attributes that a person reads or hears
const SVG = "http://www.w3.org/2000/svg";

function fill(node, attributes, children) {
  for (const [name, value] of Object.entries(attributes || {})) {
    if (value === null || value === undefined || value === false) continue;
    if (name.startsWith("on")) node.addEventListener(name.slice(2), value);
    else node.setAttribute(name, value === true ? "" : SHOWN.has(name) ? visible(value) : String(value));
  }
  for (const child of children.flat(Infinity)) {
    if (child === null || child === undefined || child === false) continue;
    node.append(child instanceof Node ? child : visible(child));
  }
  return node;
}

const h = (tag, attributes, ...children) => fill(document.createElement(tag), attributes, children);
const s = (tag, attributes, ...children) => fill(document.createElementNS(SVG, tag), attributes, children);
const byId = (id) => document.getElementById(id);
const put = (id, ...children) => fill(byId(id), null, children);

const whole = new Intl.NumberFormat("en-US");
const number = (value) => whole.format(value).replace("-", "−");
const plural = (count, one, many) => `${number(count)} ${count === 1 ? one : many || one + "s"}`;
const TOO_SHORT = "too short";

// One decimal; 100 and 0 only where nothing is missing or there. A side without lines has no share to speak of, nor has
// one whose counterpart (`other`: its lines, and which side it is) is empty.
function percent(value, lines, other) {
  if (value === null) return lines === 0 ? "–" : other && other.lines === 0 ? `no ${other.side}` : TOO_SHORT;
  const inner = value > 0 && value < 100 ? Math.min(99.9, Math.max(0.1, value)) : value;
  return `${inner.toFixed(1)} %`;
}

const roughly = (value) => `${(value > 0 && value < 100 ? Math.min(99, Math.max(1, value)) : value).toFixed(0)} %`;
const degree = (value) => value.toFixed(2).replace("-", "−");

// A signed change with its arrow, or nothing where nothing changed. `good` is the sign that is welcome: 1, -1, or 0.
function change(value, digits, good) {
  if (value === null || value === undefined) return null;
  const rounded = Number(value.toFixed(digits));
  if (rounded === 0) return h("span", { class: "change none" }, "±0");
  const tone = good === 0 ? "" : Math.sign(rounded) === good ? " better" : " worse";
  const text = digits === 0 ? number(Math.abs(rounded)) : Math.abs(rounded).toFixed(digits);
  return h("span", { class: "change" + tone }, `${rounded > 0 ? "▲ +" : "▼ −"}${text}`);
}

const NAMES = {
  in_step: "in step", drifted: "drifted", review: "to review", deferred: "deferred", ignored: "ignored",
  twin: "twin", rewritten: "rewritten", one_sided: "one-sided", unmatched: "unmatched",
};
const KINDS = ["twin", "rewritten", "one_sided", "unmatched"];
const STATES = ["in_step", "drifted", "review", "deferred", "ignored"];

const tag = (name) => h("span", { class: `tag ${name}` }, NAMES[name] || name);
const capital = (text) => text[0].toUpperCase() + text.slice(1);
