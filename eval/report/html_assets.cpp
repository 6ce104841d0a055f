#include "eval/report/html_assets.h"

namespace dressform {

const char* const kPagePolicy =
    "default-src 'none'; img-src data: blob:; media-src data:; style-src 'unsafe-inline'; script-src 'unsafe-inline' "
    "'wasm-unsafe-eval' "
    "blob:; connect-src data: blob:; worker-src blob:";

// Colours of text on their grounds have a contrast of 4.5 at least (WCAG 2, AA), in both schemes.
const char* const kPageStyle = R"(
:root { color-scheme: light dark; --ink: #222; --quiet: #5f5f5f; --ground: #fff; --line: #ddd; --link: #1c5a96;
        --good: #1b5e20; --good-ground: #e3f3e5; --bad: #9b1c1c; --bad-ground: #fdeaea; --code: #f5f5f5; }
@media (prefers-color-scheme: dark) {
  :root { --ink: #e4e4e4; --quiet: #a8a8a8; --ground: #17191c; --line: #3b3f45; --link: #8fc1f2; --good: #9bd8a2;
          --good-ground: #1d3321; --bad: #ffb0a8; --bad-ground: #41201e; --code: #212429; } }
* { box-sizing: border-box; }
body { font: 15px/1.5 system-ui, "Segoe UI", sans-serif; color: var(--ink); background: var(--ground); margin: 0 auto;
       padding: 24px; max-width: 1240px; overflow-wrap: break-word; }
h1 { font-size: 26px; margin: 0 0 4px; }
h2 { font-size: 20px; margin: 36px 0 8px; border-bottom: 1px solid var(--line); }
h3 { font-size: 16px; margin: 20px 0 6px; }
a { color: var(--link); } nav { font-size: 14px; } nav a { margin-right: 14px; display: inline-block; padding: 2px 0; }
.skip { position: absolute; left: -999em; } .skip:focus { position: static; }
.verdict { padding: 10px 14px; border-radius: 6px; margin: 14px 0; font-weight: 600; }
.verdict.good { background: var(--good-ground); color: var(--good); }
.verdict.bad { background: var(--bad-ground); color: var(--bad); }
.wide { overflow-x: auto; }
table { border-collapse: collapse; font-size: 13.5px; margin: 8px 0 14px; font-variant-numeric: tabular-nums; }
th { text-align: left; font-weight: 600; border-bottom: 2px solid var(--line); padding: 4px 14px 4px 0; }
td { border-bottom: 1px solid var(--line); padding: 3px 14px 3px 0; white-space: nowrap; }
td.best { font-weight: 700; } td.second { text-decoration: underline; }
td.good { color: var(--good); } td.bad { color: var(--bad); font-weight: 600; } td.quiet { color: var(--quiet); }
figure { margin: 10px 0 18px; }
figure img, figure svg { max-width: 100%; height: auto; border: 1px solid var(--line); background: #fff; }
figcaption { font-size: 13px; color: var(--quiet); } figcaption b { color: var(--ink); }
pre { font-size: 12px; background: var(--code); padding: 10px; overflow-x: auto; }
summary { cursor: pointer; color: var(--link); }
.layer { margin: 0 0 6px; } .layer span { font-size: 13px; display: block; }
.compare.live .layers { display: grid; } .compare.live .layer { grid-area: 1 / 1; margin: 0; align-self: start; }
.compare.live .layer span { display: none; } .compare.live .hidden { visibility: hidden; }
.controls { display: flex; flex-wrap: wrap; gap: 6px; align-items: center; margin: 6px 0; }
button { font: inherit; font-size: 13px; padding: 4px 10px; color: var(--ink); background: var(--code);
         border: 1px solid var(--quiet); border-radius: 5px; cursor: pointer; }
button[aria-pressed=true] { background: var(--link); color: var(--ground); }
.controls input { flex: 1 1 160px; max-width: 420px; }
model-viewer { width: 100%; height: 520px; background: #f2f2f2; }
@media (max-width: 600px) { body { padding: 12px; } h1 { font-size: 21px; } td { white-space: normal; } }
@media print { :root { --ink: #000; --ground: #fff; --quiet: #444; } nav, .controls, .skip, .model { display: none; }
  body { max-width: none; padding: 0; font-size: 10pt; } figure, tr { break-inside: avoid; } h2, h3 { break-after: avoid; } }
)";

const char* const kPageScript = R"(
'use strict';
function button(text, bar, press) {
  const made = document.createElement('button');
  made.type = 'button'; made.textContent = text; made.addEventListener('click', () => press(made)); bar.append(made);
  return made;
}
for (const box of document.querySelectorAll('.compare')) {
  const [made, reference, difference] = box.querySelectorAll('.layer');
  const bar = document.createElement('div'), cut = document.createElement('input'), buttons = [];
  let timer = 0;
  bar.className = 'controls'; box.prepend(bar); box.classList.add('live');
  cut.type = 'range'; cut.min = 0; cut.max = 100; cut.value = 50;
  cut.setAttribute('aria-label', 'Part of the picture that shows the new one');
  const show = (layers, part) => {
    for (const layer of [made, reference, difference]) layer.classList.toggle('hidden', !layers.includes(layer));
    made.style.clipPath = part === undefined ? '' : `inset(0 ${100 - part}% 0 0)`;
  };
  const mode = (name, pick) => buttons.push(button(name, bar, me => {
    clearInterval(timer);
    for (const other of buttons) other.setAttribute('aria-pressed', other === me);
    cut.disabled = name !== 'Slider'; pick();
  }));
  made.style.zIndex = 1;
  mode('Slider', () => show([made, reference], cut.value));
  mode('New', () => show([made]));
  mode('Reference', () => show([reference]));
  mode('Difference', () => show([difference]));
  mode('Flip', () => { let first = false;
    const turn = () => { first = !first; show([first ? made : reference]); };
    turn(); timer = setInterval(turn, 700); });
  cut.addEventListener('input', () => show([made, reference], cut.value));
  bar.append(cut); buttons[0].click();
}
function bytes(id) {
  const text = atob(document.getElementById(id).textContent.trim()), all = new Uint8Array(text.length);
  for (let i = 0; i < text.length; ++i) all[i] = text.charCodeAt(i);
  return all;
}
let viewer;
function loadViewer() {  // once, when it is first asked for: the page is there long before
  viewer = viewer || (async () => {
    const stream = new Blob([bytes('viewer-code')]).stream().pipeThrough(new DecompressionStream('gzip'));
    const script = document.createElement('script');
    script.textContent = await new Response(stream).text();
    document.head.append(script);
  })();
  return viewer;
}
for (const box of document.querySelectorAll('.model')) {
  const bar = document.createElement('div');
  bar.className = 'controls'; box.append(bar);
  button('Show in 3D: ' + box.dataset.title, bar, async me => {
    me.disabled = true; me.textContent = 'Loading';
    await loadViewer();
    const model = document.createElement('model-viewer');
    const url = URL.createObjectURL(new Blob([bytes(box.dataset.model)], {type: 'model/gltf-binary'}));
    model.setAttribute('alt', box.dataset.title + ', to be turned with mouse, finger or arrow keys');
    for (const name of ['camera-controls', 'disable-tap']) model.setAttribute(name, '');
    model.setAttribute('interaction-prompt', 'none'); model.setAttribute('src', url);
    bar.replaceWith(model);
  });
}
)";

}  // namespace dressform
