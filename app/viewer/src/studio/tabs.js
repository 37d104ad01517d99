// Panels with tabs as in ARIA: arrow keys move from tab to tab.

export function tabs(list) {
  const all = [...list.querySelectorAll('[role="tab"]')];
  const choose = (tab) => {
    for (const each of all) {
      const on = each === tab;
      each.setAttribute("aria-selected", String(on));
      each.tabIndex = on ? 0 : -1;
      document.getElementById(each.getAttribute("aria-controls")).hidden = !on;
    }
    window.dispatchEvent(new Event("panel"));
  };
  for (const tab of all) tab.addEventListener("click", () => choose(tab));
  list.addEventListener("keydown", (event) => {
    const by = {ArrowRight: 1, ArrowLeft: -1}[event.key], at = all.indexOf(document.activeElement);
    if (!by || at < 0) return;
    const next = all[(at + by + all.length) % all.length];
    choose(next);
    next.focus();
    event.preventDefault();
  });
}
