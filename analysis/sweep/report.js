"use strict";
(() => {
  const tip = document.getElementById("tip");
  const all = (selector, root = document) => [...root.querySelectorAll(selector)];

  function showTip(mark) {
    tip.textContent = mark.dataset.hover;
    tip.hidden = false;
    const at = mark.querySelector(".hit").getBoundingClientRect();
    const size = tip.getBoundingClientRect();
    const left = at.right + 8 + size.width > innerWidth ? at.left - 8 - size.width : at.right + 8;
    const top = Math.min(at.top, innerHeight - size.height - 8);
    tip.style.left = Math.max(4, left) + "px";
    tip.style.top = Math.max(4, top) + "px";
  }
  function hideTip() { tip.hidden = true; }
  for (const mark of all(".mark")) {
    mark.addEventListener("pointerenter", () => showTip(mark));
    mark.addEventListener("pointerleave", hideTip);
    mark.addEventListener("focus", () => showTip(mark));
    mark.addEventListener("blur", hideTip);
  }
  addEventListener("keydown", event => { if (event.key === "Escape") hideTip(); });

  addEventListener("beforeprint", () => { for (const folded of all("details")) folded.open = true; });

  // The front of the marks that are shown: the step ends where it began, above and at the right.
  function drawFront(chart) {
    const line = chart.querySelector(".front-line"), path = line && line.querySelector("path");
    if (!path) return;
    path.dataset.whole ??= path.getAttribute("d");
    const places = path.dataset.whole.match(/-?[\d.]+,-?[\d.]+/g).map(place => place.split(",").map(Number));
    const top = places[0][1], right = places[places.length - 1][0], sign = line.dataset.better === "high" ? -1 : 1;
    const marks = all(".mark", chart).map(mark => ({ mark, x: Number(mark.dataset.x.replace("inf", "Infinity")),
      y: sign * Number(mark.dataset.y.replace("inf", "Infinity")), hit: mark.querySelector(".hit") }));
    for (const { mark } of marks) mark.classList.remove("front");
    let last, d = "";
    for (const one of marks.filter(m => !m.mark.classList.contains("is-off")).sort((a, b) => a.x - b.x || a.y - b.y)) {
      if (last && !(one.y < last.y) && !(one.x === last.x && one.y === last.y)) continue;
      const x = one.hit.getAttribute("cx"), y = one.hit.getAttribute("cy");
      d += last ? `L${x},${last.hit.getAttribute("cy")} L${x},${y} ` : `M${x},${top} L${x},${y} `;
      one.mark.classList.add("front");
      last = one;
    }
    path.setAttribute("d", last ? d + `L${right},${last.hit.getAttribute("cy")}` : "M0,0");
  }

  // A series is shown or hidden in all charts, lists of fronts and legends at once.
  for (const button of all(".legend button"))
    button.addEventListener("click", () => {
      const series = button.dataset.series;
      const on = button.getAttribute("aria-pressed") !== "true";
      for (const other of all(`.legend button[data-series="${series}"]`)) other.setAttribute("aria-pressed", String(on));
      for (const part of all(`.mark[data-series="${series}"], .bars[data-series="${series}"], .front tr[data-series="${series}"]`))
        part.classList.toggle("is-off", !on);
      all(".chart").forEach(drawFront);
    });

  // Empty cells go last in either order; equal cells keep their order.
  const collator = new Intl.Collator(undefined, { numeric: true });
  for (const table of all("table.sortable")) {
    const headings = all("thead th", table), body = table.tBodies[0];
    headings.forEach((heading, column) => heading.querySelector("button").addEventListener("click", () => {
      const descending = heading.getAttribute("aria-sort") === "ascending";
      for (const other of headings) other.removeAttribute("aria-sort");
      heading.setAttribute("aria-sort", descending ? "descending" : "ascending");
      const numeric = heading.classList.contains("num"), sign = descending ? -1 : 1;
      const keyed = all("tr", body).map(row => {
        const cell = row.cells[column], text = numeric ? cell.dataset.v : cell.textContent;
        return { row, empty: text === undefined || text === "", key: numeric ? Number(text) : text };
      });
      keyed.sort((a, b) => a.empty || b.empty ? a.empty - b.empty
        : sign * (numeric ? a.key - b.key || 0 : collator.compare(a.key, b.key)));
      body.append(...keyed.map(entry => entry.row));
    }));
  }

  // All pictures of a panel show the same place; a press holds it, another lets go.
  const enlargement = 4;
  for (const group of all(".picture-rows")) {
    let held = false;
    const pictures = all(".lens svg", group);
    const place = (lens, event) => {
      const box = lens.getBoundingClientRect();
      const x = 100 * (event.clientX - box.left) / box.width, y = 100 * (event.clientY - box.top) / box.height;
      for (const picture of pictures) {
        picture.style.transformOrigin = `${x}% ${y}%`;
        picture.style.transform = `scale(${enlargement})`;
      }
    };
    const release = () => { for (const picture of pictures) picture.style.transform = ""; };
    for (const lens of all(".lens", group)) {
      lens.addEventListener("pointermove", event => { if (!held) place(lens, event); });
      lens.addEventListener("pointerleave", () => { if (!held) release(); });
      lens.addEventListener("click", event => { held = !held; place(lens, event); });
    }
  }
})();
