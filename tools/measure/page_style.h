// How the page looks.
#pragma once

namespace overlook::measure {

inline constexpr char kPageStyle[] = R"(:root { color-scheme: light; }
* { box-sizing: border-box; }
body { margin: 0; background: #ffffff; color: #1c2126; font: 16px/1.5 system-ui, "DejaVu Sans", Verdana, sans-serif; }
main { max-width: 1240px; margin: 0 auto; padding: 16px 20px 48px; }
h1 { font-size: 1.7rem; line-height: 1.25; margin: 0.6em 0 0.2em; overflow-wrap: anywhere; }
h2 { font-size: 1.3rem; margin: 2em 0 0.6em; padding-top: 0.5em; border-top: 1px solid #cfd6dc; }
h3 { font-size: 1.05rem; margin: 0.8em 0 0.4em; overflow-wrap: anywhere; }
pre { background: #f1f4f6; padding: 10px 12px; white-space: pre-wrap; overflow-wrap: anywhere; font-size: 0.9rem; }
pre span { display: inline-block; max-width: 100%; }
.name span { white-space: nowrap; }
code { color: #59636c; }
a { color: #005a92; }
table { border-collapse: collapse; font-size: 0.93rem; }
.facts th { min-width: 7.5em; text-align: left; font-weight: 600; padding: 3px 18px 3px 0; vertical-align: top; }
.facts td { padding: 3px 0; overflow-wrap: anywhere; }
.wide { overflow-x: auto; }
.runs th, .runs td { padding: 5px 7px; border-bottom: 1px solid #e1e6ea; text-align: right; }
.runs td { font-variant-numeric: tabular-nums; white-space: nowrap; }
.runs thead th { vertical-align: bottom; border-bottom: 2px solid #8a949c; }
.runs th:first-child { text-align: left; position: sticky; left: 0; background: #ffffff; font-weight: 600; }
.runs thead th { font-weight: 600; }
.runs td:last-child { text-align: left; white-space: normal; min-width: 8em; }
.matrix th, .matrix td, .matrix td:last-child { text-align: left; vertical-align: top; }
.runs .floor td, .runs .floor th { background: #eceff1; }
.software { background: #fff1c9; padding: 1px 7px; white-space: nowrap; font-weight: 600; }
.broken { color: #9c2f00; }
.note { color: #4a545c; font-size: 0.93rem; }
figure { margin: 0 0 1.6em; }
figure img { display: block; width: 100%; height: auto; }
figcaption { color: #333c44; font-size: 0.95rem; }
.three { display: grid; grid-template-columns: repeat(3, 1fr); gap: 10px; }
.three figure { margin: 0 0 0.6em; }
section { margin-bottom: 1.6em; }
@media (max-width: 640px) {
  main { padding: 8px 12px 32px; }
  .three { grid-template-columns: 1fr; }
  .facts th, .facts td { display: block; padding: 2px 0 0; }
  .facts th { padding-top: 6px; }
  .matrix thead { display: none; }
  .matrix, .matrix tbody, .matrix tr { display: block; }
  .matrix tr { display: grid; grid-template-columns: 1fr auto; gap: 2px 12px; padding: 8px 0; border-bottom: 1px solid #e1e6ea; }
  .matrix th, .matrix td { border: 0; padding: 0; }
  .matrix th:first-child { position: static; }
  .matrix td:nth-child(3) { grid-row: 2; grid-column: 1 / 3; white-space: normal; overflow-wrap: anywhere; }
  .matrix td:nth-child(4) { display: none; }
  .matrix td:last-child { grid-row: 3; grid-column: 1 / 3; min-width: 0; }
}
)";

}  // namespace overlook::measure
