// Puts the page together: theme, addresses, keys.

const theme = {
  read() {
    try { return localStorage.getItem("porttool-theme"); } catch { return null; }
  },
  keep(name) {
    try { localStorage.setItem("porttool-theme", name); } catch { /* a page from a file may have no storage */ }
  },
  show(name) {
    document.documentElement.dataset.theme = name;
    byId("theme").textContent = name === "dark" ? "Light" : "Dark";
    paintMap();
  },
};

const systemTheme = matchMedia("(prefers-color-scheme: dark)");

// What the address names: a unit, lines of a block, or a choice in the list.
function follow(event) {
  const { place, values } = parseAddress(location.hash);
  const dialog = byId("viewer");
  if (place === "unit" && openUnit(values.key)) return;
  if (place === "code" && openCode(values)) return;
  if (dialog.open) dialog.close();
  if (place === "units" && location.hash.includes("?")) {
    choose(values);
    byId("units").scrollIntoView({ behavior: event ? "auto" : "instant" });
  } else if (!event && byId(place)) {
    byId(place).scrollIntoView({ behavior: "instant" });  // the page was empty when the browser looked for it
  }
}

function onKey(event) {
  const typing = event.target.closest && event.target.closest("input, select, textarea");
  if (event.ctrlKey || event.metaKey || event.altKey) return;
  const dialog = byId("viewer");
  if (dialog.open && (event.key === "ArrowLeft" || event.key === "ArrowRight")) {
    const button = dialog.querySelector(`[aria-keyshortcuts="${event.key}"]`);
    if (button) { event.preventDefault(); button.click(); }
  } else if (event.key === "/" && !typing && !dialog.open) {
    event.preventDefault();
    byId("choose-q").focus();
    byId("choose-q").select();
  } else if (event.key === "Escape" && typing && typing.id === "choose-q") {
    typing.blur();
  }
}

byId("twin-bound").textContent = report.parameters.twin_percent;
showSummary();
showBlocks();
showLines();
showSpeed();
showTargets();
showMap();
showLedger();
showUnits();
theme.show(theme.read() || (systemTheme.matches ? "dark" : "light"));
byId("theme").addEventListener("click", () => {
  const name = document.documentElement.dataset.theme === "dark" ? "light" : "dark";
  theme.keep(name);
  theme.show(name);
});
systemTheme.addEventListener("change", () => { if (!theme.read()) theme.show(systemTheme.matches ? "dark" : "light"); });
byId("viewer").addEventListener("close", () => {
  const back = returnTo;
  returnTo = null;
  if (/^#(unit|code)\?/.test(location.hash)) history.replaceState(null, "", listAddress(chosen));
  if (back && back.isConnected) back.focus({ preventScroll: true });
});
byId("viewer").addEventListener("click", (event) => { if (event.target === byId("viewer")) closeViewer(); });
addEventListener("hashchange", follow);
addEventListener("keydown", onKey);
// On paper: every unit, and always the light theme.
addEventListener("beforeprint", () => { printing = true; shown = Infinity; refreshList(); paintMap(); });
addEventListener("afterprint", () => { printing = false; shown = PAGE; refreshList(); paintMap(); });
let lastWidth = innerWidth;
addEventListener("resize", () => {
  if (innerWidth === lastWidth) return;
  lastWidth = innerWidth;
  paintMap();
});
follow();
document.documentElement.dataset.ready = "";
