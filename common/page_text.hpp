// The style and the script of every page.
#pragma once

namespace navjit::common {

/// Colours for light and dark; six that are told apart, also by those who see fewer colours.
inline constexpr char page_style[] = R"(
:root { color-scheme: light dark; --ink: #1c2430; --soft: #5b6675; --paper: #ffffff; --line: #d5dae1;
  --shade: #f3f5f8; --k1: #0b6bb0; --k2: #c6561a; --k3: #2a8a57; --k4: #9448a0; --k5: #a07d00; --k6: #6b7480; }
@media (prefers-color-scheme: dark) { :root { --ink: #e4e8ee; --soft: #a2adba; --paper: #14181e;
  --line: #38414d; --shade: #1e242c; --k1: #5cb2f0; --k2: #f08a4c; --k3: #5cc48e; --k4: #cf8edb;
  --k5: #d9b93c; --k6: #9aa4b0; } }
* { box-sizing: border-box; }
body { margin: 0 auto; padding: 1.5rem; max-width: 72rem; background: var(--paper); color: var(--ink);
  font: 15px/1.5 system-ui, "Segoe UI", "DejaVu Sans", sans-serif; }
h1 { font-size: 1.5rem; margin: 0 0 .5rem; overflow-wrap: anywhere; }
h2 { font-size: 1.15rem; margin: 2rem 0 .5rem; border-bottom: 1px solid var(--line); }
p { margin: .5rem 0; max-width: 60rem; }
.wide { overflow-x: auto; }
table { border-collapse: collapse; font-size: .87rem; }
.sorts { width: 100%; }
th, td { text-align: left; vertical-align: top; padding: .2rem .5rem; border-bottom: 1px solid var(--line); }
.sorts td:first-child { min-width: 12rem; }
.sorts td:last-child:not(.n) { min-width: 10rem; }
.sorts td:first-child, .sorts td:last-child, .facts td { overflow-wrap: anywhere; }
.facts th { font-weight: 500; color: var(--soft); white-space: nowrap; }
td.n { text-align: right; font-variant-numeric: tabular-nums; white-space: nowrap; }
th button { all: unset; cursor: pointer; font-weight: 600; }
th button:focus-visible { outline: 2px solid var(--k1); }
th[aria-sort=ascending] button::after { content: " \25B2"; }
th[aria-sort=descending] button::after { content: " \25BC"; }
tbody tr:hover { background: var(--shade); }
figure { margin: .5rem 0; }
figure img { max-width: 100%; background: #ffffff; image-rendering: pixelated; }
figcaption, .legend { color: var(--soft); font-size: .87rem; }
.key { margin-right: 1rem; white-space: nowrap; }
.key i { display: inline-block; width: .8em; height: .8em; margin-right: .35em; }
.bar { display: flex; height: 1.4rem; }
svg { max-width: 100%; height: auto; display: block; }
svg text { fill: var(--soft); font-size: 12px; }
svg .grid { stroke: var(--line); }
svg .mark { stroke: var(--soft); }
i.k1, .bar .k1 { background: var(--k1); } i.k2, .bar .k2 { background: var(--k2); }
i.k3, .bar .k3 { background: var(--k3); } i.k4, .bar .k4 { background: var(--k4); }
i.k5, .bar .k5 { background: var(--k5); } i.k6, .bar .k6 { background: var(--k6); }
i.mark { background: var(--soft); }
svg .k1 { stroke: var(--k1); } svg .k2 { stroke: var(--k2); } svg .k3 { stroke: var(--k3); }
svg .k4 { stroke: var(--k4); } svg .k5 { stroke: var(--k5); } svg .k6 { stroke: var(--k6); }
svg circle { fill: var(--paper); stroke-width: 2; }
svg polyline.k2 { stroke-dasharray: 9 4; } svg polyline.k3 { stroke-dasharray: 3 3; }
svg polyline.k4 { stroke-dasharray: 12 3 3 3; } svg polyline.k6 { stroke-dasharray: 6 6; }
@media print { :root { color-scheme: light; --ink: #000000; --soft: #444444; --paper: #ffffff;
    --line: #bbbbbb; --shade: #ffffff; --k1: #0b6bb0; --k2: #c6561a; --k3: #2a8a57; --k4: #9448a0;
    --k5: #a07d00; --k6: #6b7480; }
  body { font-size: 9pt; max-width: none; padding: 0; } table { font-size: 7.5pt; }
  .sorts td:first-child, .sorts td:last-child:not(.n) { min-width: 0; } th, td { padding: .1rem .3rem; }
  .wide { overflow: visible; } tr, figure, svg { break-inside: avoid; } h2 { break-after: avoid; }
  .bar span, i { print-color-adjust: exact; } th[aria-sort] button::after { content: ""; } }
)";

/// A click sorts by a column: numbers the largest first, texts from a to z, and the other way round
/// at the next click. What has no number comes last.
inline constexpr char page_script[] = R"(
"use strict";
for (const table of document.querySelectorAll("table.sorts")) {
  const heads = [...table.tHead.rows[0].cells], body = table.tBodies[0];
  heads.forEach((head, column) => head.firstChild.addEventListener("click", () => {
    const value = row => row.cells[column].dataset.v;
    const numbers = [...body.rows].some(row => value(row) !== undefined);
    const was = head.getAttribute("aria-sort");
    const up = was === null ? !numbers : was !== "ascending";
    heads.forEach(other => other.removeAttribute("aria-sort"));
    head.setAttribute("aria-sort", up ? "ascending" : "descending");
    const order = (a, b) => {
      if (!numbers) {
        return (up ? 1 : -1) * a.cells[column].textContent.localeCompare(b.cells[column].textContent);
      }
      const u = value(a), v = value(b);
      if (u === undefined || v === undefined) return (u === undefined) - (v === undefined);
      return (up ? 1 : -1) * (u - v);
    };
    body.append(...[...body.rows].sort(order));
  }));
}
)";

}  // namespace navjit::common
