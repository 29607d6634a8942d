#include "reports/pages/html/style.hpp"

namespace reports {

// Fates of the scoreboard: light blue, amber and dark vermilion differ in lightness, so that they are told
// apart in any vision and in print; each cell has its mark too.
const char* page_style() {
  return R"(
:root { color-scheme: light dark; --text: #1b1f24; --faint: #57606a; --page: #ffffff; --panel: #f4f6f8;
  --rule: #d5dae0; --link: #0b5cad; --good: #14703a; --good-panel: #e2f4e8; --bad: #b3201c; --bad-panel: #fde8e6;
  --warn-panel: #fdf3d8; }
@media (prefers-color-scheme: dark) { :root { --text: #e3e8ee; --faint: #9aa5b1; --page: #14181d; --panel: #1d232a;
  --rule: #37414c; --link: #79b8ff; --good: #6fd693; --good-panel: #16301f; --bad: #ff9b94; --bad-panel: #3c1a1a;
  --warn-panel: #352c12; } }
* { box-sizing: border-box; } [hidden] { display: none !important; }
html { scroll-padding-top: 1rem; }
body { margin: 0; font: 16px/1.5 system-ui, "Segoe UI", Roboto, "Helvetica Neue", Arial, sans-serif;
  color: var(--text); background: var(--page); }
.skip { position: absolute; left: -99rem; } .skip:focus { left: .5rem; top: .5rem; background: var(--page); padding: .5rem; z-index: 9; }
:focus-visible { outline: 3px solid var(--link); outline-offset: 2px; }
.layout { display: grid; grid-template-columns: 17.5rem minmax(0, 1fr); max-width: 96rem; margin: 0 auto; }
.side { position: sticky; top: 0; height: 100vh; overflow-y: auto; padding: 1rem; border-right: 1px solid var(--rule);
  background: var(--panel); font-size: .88rem; }
.side ul { list-style: none; margin: 0; padding: 0; } .side li { margin: .1rem 0; } .side li li { padding-left: .9rem; }
.side summary { cursor: pointer; } .menu > summary { display: none; } .side a { text-decoration: none; } .side a:hover { text-decoration: underline; }
.side a[aria-current] { font-weight: 700; } .side label { display: block; margin-top: .4rem; color: var(--faint); }
.side input, .side select, .side button { width: 100%; font: inherit; padding: .3rem .4rem; color: var(--text); background: var(--page);
  border: 1px solid var(--rule); border-radius: .3rem; } .side button { margin-top: .5rem; cursor: pointer; }
.side .badge { float: right; font-weight: 700; } .filters { border-bottom: 1px solid var(--rule); padding-bottom: .8rem; margin-bottom: .8rem; }
main { min-width: 0; padding: 1rem 1.75rem 3rem; }
h1 { font-size: 1.6rem; margin: 0; } h2 { font-size: 1.35rem; margin: 2.5rem 0 .5rem; padding-top: .75rem;
  border-top: 1px solid var(--rule); } h3 { font-size: 1.08rem; margin: 1.4rem 0 .3rem; } h4 { font-size: .95rem; margin: 1rem 0 .3rem; }
p { margin: .4rem 0; max-width: 60rem; } a { color: var(--link); } .faint { color: var(--faint); }
h2 > a.link, h3 > a.link { text-decoration: none; opacity: 0; margin-left: .4rem; font-weight: 400; }
h2:hover > a.link, h3:hover > a.link, a.link:focus { opacity: 1; }
.banner { padding: .9rem 1.25rem; border-radius: .5rem; border-left: .5rem solid; margin-bottom: .8rem; }
.banner.pass { background: var(--good-panel); border-color: var(--good); }
.banner.fail { background: var(--bad-panel); border-color: var(--bad); }
.warnings { background: var(--warn-panel); padding: .5rem 1.25rem; border-radius: .5rem; }
.facts { display: grid; grid-template-columns: max-content minmax(0, 1fr); gap: .15rem 1rem; margin: .6rem 0; max-width: 66rem; }
.facts dt { color: var(--faint); } .facts dd { margin: 0; }
.pass > b, td.pass, b.pass { color: var(--good); font-weight: 700; } .fail > b, td.fail, b.fail { color: var(--bad); font-weight: 700; }
.headlines { display: grid; grid-template-columns: repeat(3, minmax(0, 1fr)); gap: .8rem; margin: .8rem 0; padding: 0; list-style: none; }
.headlines li { border: 1px solid var(--rule); border-radius: .5rem; padding: .6rem .8rem; border-top: .3rem solid var(--good); }
.headlines li.fail { border-top-color: var(--bad); } .headlines .value { font-size: 1.35rem; font-weight: 700; font-variant-numeric: tabular-nums; }
.headlines p { margin: .1rem 0; font-size: .86rem; line-height: 1.35; } .headlines figure { margin: .4rem 0 0; } .headlines svg { max-height: 11rem; }
.scroll { overflow-x: auto; margin: .5rem 0 1rem; }
table { border-collapse: collapse; font-size: .9rem; font-variant-numeric: tabular-nums; }
th, td { padding: .3rem .65rem; border-bottom: 1px solid var(--rule); text-align: left; vertical-align: top; }
th { background: var(--panel); white-space: nowrap; } td.n, th.n { text-align: right; white-space: nowrap; }
tr.reason th { white-space: normal; font-weight: 400; color: var(--faint); }
td.reason { min-width: 14rem; color: var(--faint); } td.w { min-width: 11rem; } td.out { color: var(--faint); font-style: italic; }
.study { border: 1px solid var(--rule); border-left: .3rem solid var(--good); border-radius: .35rem; padding: .1rem 1rem .5rem; margin: .7rem 0; }
.study.fail { border-left-color: var(--bad); } .study h3 { margin: .4rem 0 .1rem; } .study summary { cursor: pointer; color: var(--link); }
.claim { border: 1px solid var(--rule); border-radius: .35rem; padding: .5rem 1rem; margin: .6rem 0; }
.claim blockquote { margin: .2rem 0 .4rem; font-style: italic; } .verdict { font-weight: 700; }
figure { margin: 1rem 0 1.2rem; } figcaption { font-size: .9rem; margin-top: .35rem; max-width: 60rem; }
figure > svg, figure > a > svg, figure > img { display: block; width: 100%; max-width: 60rem; height: auto; background: #ffffff; border: 1px solid var(--rule);
  border-radius: .35rem; } svg.marks { position: absolute; }
code { font-size: .9em; overflow-wrap: anywhere; } td { overflow-wrap: break-word; }
.board { overflow: auto; max-height: 92vh; }
.board table { font-size: .66rem; line-height: 1.3; border-collapse: separate; border-spacing: 1px; }
.board th, .board td { padding: .1rem .1rem; border: 0; white-space: nowrap; }
.board thead th { position: sticky; top: 0; z-index: 2; padding-top: .4rem; vertical-align: bottom; font-weight: 600; }
.board thead th span { writing-mode: vertical-rl; transform: rotate(180deg); }
.board tbody th { position: sticky; left: 0; z-index: 1; font-weight: 400; }
.board thead th:first-child { left: 0; z-index: 3; } .board tr.group th { font-weight: 700; padding-top: .5rem; }
.board td { text-align: center; min-width: 1.9rem; } .board td.none { color: var(--faint); }
.fate { padding: 0 .25rem; } .survived { background: #cfe4f7; color: #0b2a45; } .degraded { background: #f5b942; color: #2b1c00; }
.diverged, .failed { background: #8f2a16; color: #ffffff; } .unexpected { outline: 3px solid #ff0033; outline-offset: -1px; font-weight: 700; }
.paper-only { display: none; }
@media (max-width: 60rem) { .layout { display: block; } .side { position: static; height: auto; border-right: 0; border-bottom: 1px solid var(--rule); }
  .menu > summary { display: list-item; font-weight: 600; } .side nav { max-height: 14rem; overflow-y: auto; } main { padding: .75rem .9rem 2rem; } .headlines { grid-template-columns: repeat(2, minmax(0, 1fr)); } }
@media (max-width: 40rem) { th, td { padding: .3rem .4rem; } h1 { font-size: 1.3rem; } .headlines { grid-template-columns: 1fr; } .facts { grid-template-columns: 1fr; }
  table.cards thead { display: none; } table.cards, table.cards tbody, table.cards tr { display: block; }
  table.cards tr { border-bottom: 1px solid var(--rule); padding: .35rem 0; }
  table.cards td { display: block; border: 0; padding: 0 .2rem; text-align: left; white-space: normal; min-width: 0; }
  td[data-label]::before { content: attr(data-label) ": "; color: var(--faint); } }
@page { size: A4; margin: 18mm 16mm; }
@media print { :root { color-scheme: light; --text: #000; --faint: #333; --page: #fff; --panel: #eee; --rule: #999; --link: #000;
  --good: #14703a; --good-panel: #fff; --bad: #b3201c; --bad-panel: #fff; --warn-panel: #fff; }
  body { font-size: 9.5pt; line-height: 1.4; } .layout { display: block; } .side, .skip, a.link, .screen-only { display: none; } .paper-only { display: block; }
  main { max-width: none; padding: 0; } figure, tr, .claim, .headlines li { break-inside: avoid; } h2 { break-before: page; border: 0; }
  h2, h3, h4 { break-after: avoid; } .scroll { overflow: visible; } table { font-size: 8pt; max-width: 100%; } th { white-space: normal; }
  td.w, td.reason { min-width: 0; } a { text-decoration: none; } .headlines li, .banner { border-color: #999; print-color-adjust: exact; -webkit-print-color-adjust: exact; }
  figure > svg, figure > a > svg { max-height: 125mm; } .study { border: 0; padding: 0; } .title-page { min-height: 230mm; }
  .board { overflow: visible; max-height: none; width: auto; margin: 0; } .board table { font-size: 4.6pt; }
  .fate, .board td { print-color-adjust: exact; -webkit-print-color-adjust: exact; } }
)";
}

const char* page_script() {
  return R"(
(() => {
  const all = (selector, root = document) => [...root.querySelectorAll(selector)];
  const studies = all('.study'), chapters = all('.chapter'), items = new Map(all('.side li[data-study]').map(li => [li.dataset.study, li]));
  const search = document.getElementById('search'), count = document.getElementById('count');
  const selects = ['status', 'topic', 'scheme'].map(key => [key, document.getElementById('filter-' + key)]);
  const text = new Map();
  const words = study => {
    if (!text.has(study)) text.set(study, study.textContent.toLowerCase());
    return text.get(study);
  };
  const keep = () => {
    const query = new URLSearchParams();
    if (search.value) query.set('q', search.value);
    for (const [key, select] of selects) if (select.value) query.set(key, select.value);
    const rest = query.toString();
    try { history.replaceState(null, '', location.pathname + (rest ? '?' + rest : '') + location.hash); } catch (e) {}
  };
  const apply = () => {
    const wanted = search.value.toLowerCase().split(/\s+/).filter(Boolean);
    let shown = 0;
    for (const study of studies) {
      const fits = selects.every(([key, select]) => !select.value || (study.dataset[key] || '').split(' ').includes(select.value)) &&
        wanted.every(word => words(study).includes(word));
      study.hidden = !fits;
      shown += fits;
      const id = study.id, item = items.get(id);
      if (item) item.hidden = !fits;
      const row = document.querySelector('tr[data-study="' + id + '"]');
      if (row) row.hidden = !fits;
    }
    const filtered = wanted.length > 0 || selects.some(([, select]) => select.value);
    for (const chapter of chapters) {
      const any = all('.study', chapter).some(study => !study.hidden);
      chapter.hidden = filtered && !any;
      const entry = document.querySelector('.side li[data-chapter="' + chapter.id + '"]');
      if (!entry) continue;
      entry.hidden = chapter.hidden;
      const fold = entry.querySelector('details');
      if (fold && filtered) fold.open = any;
    }
    document.body.classList.toggle('filtered', filtered);
    count.textContent = shown + ' of ' + studies.length + ' studies';
  };
  const reveal = () => {
    const target = location.hash && document.getElementById(decodeURIComponent(location.hash.slice(1)));
    if (!target) return;
    if (target.closest('[hidden]')) reset();
    for (let part = target; part; part = part.parentElement) if (part.tagName === 'DETAILS') part.open = true;
    const fold = target.matches('.study') && target.querySelector('details');
    if (fold) fold.open = true;
    target.scrollIntoView();
  };
  const reset = () => { search.value = ''; for (const [, select] of selects) select.value = ''; apply(); keep(); };
  const query = new URLSearchParams(location.search);
  search.value = query.get('q') || '';
  for (const [key, select] of selects) select.value = query.get(key) || '';
  search.addEventListener('input', () => { apply(); keep(); });
  for (const [, select] of selects) select.addEventListener('change', () => { apply(); keep(); });
  document.getElementById('reset').addEventListener('click', reset);
  addEventListener('hashchange', reveal);
  addEventListener('keydown', event => {
    if (event.key === '/' && !/INPUT|SELECT|TEXTAREA/.test(document.activeElement.tagName)) { event.preventDefault(); document.querySelector('.menu').open = true; search.focus(); }
  });
  if (!matchMedia('(min-width: 60rem)').matches) document.querySelector('.menu').open = false; // the verdict comes first
  apply();
  reveal();
  if ('IntersectionObserver' in window) {
    const links = new Map(all('.side a').map(a => [a.getAttribute('href').slice(1), a]));
    const seen = new IntersectionObserver(entries => {
      for (const entry of entries) {
        const link = links.get(entry.target.id);
        if (!link || !entry.isIntersecting) continue;
        for (const other of links.values()) other.removeAttribute('aria-current');
        link.setAttribute('aria-current', 'true');
      }
    }, {rootMargin: '0px 0px -70% 0px'});
    for (const part of [...chapters, ...studies]) seen.observe(part);
  }
  document.documentElement.dataset.ready = 'true';
})();
)";
}

}  // namespace reports
