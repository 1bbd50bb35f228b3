// Wires the module to the page.

import { Engine, MAILBOX, STRUCTURE } from "./engine.js";
import { Orbit } from "./orbit.js";
import { Painter } from "./painter.js";
import { built, bytes, compact, count, rough } from "./words.js";

const $ = (id) => document.getElementById(id);
const SMALLEST = 1024;
// Steps of the budget from one power of two to the next.
const STEPS = 8;
// A full picture follows when the view has rested for so many milliseconds.
const REST = 160;

const budgetAt = (step) => Math.round((SMALLEST * 2 ** (step / STEPS)) / 8) * 8;
const stepFor = (needed) => Math.ceil(Math.log2(needed / SMALLEST) * STEPS - 1e-9);

function element(name, properties = {}, ...children) {
  const made = Object.assign(document.createElement(name), properties);
  made.append(...children);
  return made;
}

function rows(table, entries) {
  table.tBodies[0].replaceChildren(
    ...entries.map(([name, value, part]) => {
      const head = element("th", { scope: "row" }, name);
      if (part !== undefined) head.prepend(element("span", { className: `key part${part}` }));
      return element("tr", {}, head, element("td", {}, value));
    }),
  );
}

function state(name, text) {
  document.body.dataset.state = name;
  if ($("status").textContent !== text) $("status").textContent = text;
}

function say(title, text, act) {
  $("message").hidden = false;
  $("message-title").textContent = title;
  $("message-text").textContent = text;
  $("message-act").hidden = !act;
  if (act) {
    $("message-act").textContent = act.label;
    $("message-act").onclick = act.run;
  }
}

function showMemory(report) {
  const free = Math.max(0, report.capacity - report.used);
  const parts = report.parts.map(({ name, bytes }, i) => ({ name, bytes, part: i % 6 }));
  const all = [...parts, { name: "free", bytes: free, part: "free" }];
  $("stack").replaceChildren(
    ...all.map(({ bytes, part }) => {
      const bar = element("span", { className: `part${part}` });
      bar.style.flexGrow = String(bytes);
      return bar;
    }),
  );
  rows($("parts"), [
    ...all.map(({ name, bytes: n, part }) => [name, bytes(n), part]),
    ["most at once, while building", bytes(report.highWater)],
    ["the scene itself, in flash on a device", bytes(report.sceneBytes)],
  ]);
  $("note").textContent = built(report);
}

function showWork(report, picture) {
  const total = report.primary + report.shadow + report.secondary;
  if (!total) return;
  $("tests").textContent = rough(report.tests / total);
  $("steps").textContent = rough(report.steps / total);
  $("speed").textContent = picture.spent ? compact((total / picture.spent) * 1000) : "–";
  rows($("rays"), [
    ["from the eye", count(report.primary)],
    ["towards lights", count(report.shadow)],
    ["mirrored and refracted", count(report.secondary)],
    [`tests saved by the mailbox (${MAILBOX[report.mailbox]})`, count(report.skips)],
    ["time of the picture", `${rough(picture.spent / 1000)} s`],
  ]);
}

function forget() {
  for (const id of ["tests", "steps", "speed", "crc"]) $(id).textContent = "–";
  for (const id of ["rays", "parts"]) rows($(id), []);
  $("stack").replaceChildren();
  $("note").textContent = "";
}

function start(engine) {
  const scenes = engine.scenes();
  const canvas = $("canvas");
  const painter = new Painter(canvas, engine, { progress, done });
  const orbit = new Orbit(canvas, moved);
  let rest = 0;
  let shown = -1;
  let pending = 0;

  scenes.forEach(({ title, about }, value) =>
    $("scene").append(element("option", { value }, about ? `${title}: ${about}` : title)));

  function progress(picture) {
    $("progress").style.width = `${(100 * picture.next) / picture.image.height}%`;
    if (!picture.quick) showWork(engine.report(), picture);
  }

  function done(picture) {
    $("progress").style.width = "0";
    $("brightest").textContent = count(painter.brightest);
    if (picture.quick) return;
    showWork(engine.report(), picture);
    $("crc").textContent = picture.crc;
    state("done", `Done: ${picture.image.width} by ${picture.image.height} pixels in ${rough(picture.spent / 1000)} seconds.`);
  }

  function draw(quick) {
    clearTimeout(rest);
    const eye = orbit.eye();
    canvas.dataset.eye = eye.join(" ");
    $("crc").textContent = "–";
    state("working", "Rendering.");
    painter.begin(eye, quick);
    if (quick) rest = setTimeout(() => draw(false), REST);
  }

  function moved() {
    if ($("message").hidden) draw(true);
  }

  function rebuild() {
    pending = 0;
    const scene = Number($("scene").value);
    const ram = budgetAt($("ram").value);
    if (scene !== shown) orbit.start(scenes[scene]);
    const outcome = engine.select({
      scene, ram, structure: Number($("structure").value), mailbox: Number($("mailbox").value),
    });
    const report = engine.report();
    if (outcome === "built") {
      $("message").hidden = true;
      canvas.setAttribute("aria-label", `Picture of the scene ${scenes[scene].title}; arrow keys turn it`);
      showMemory(report);
      draw(scene !== shown);
      shown = scene;
      return;
    }
    painter.stop();
    clearTimeout(rest);
    forget();
    $("progress").style.width = "0";
    if (outcome === "small") {
      refuse(report, ram);
    } else {
      say("This cannot be built", "The structure has no room for so many entries; choose another one.");
    }
    state("refused", "Nothing is rendered.");
  }

  // Not even the least of what was asked for fits.
  function refuse(report, ram) {
    const kind = STRUCTURE[Number($("structure").value) - 1];
    const what = kind === "none" || kind === undefined ? "What you chose" : `The smallest ${kind} over this scene`;
    const step = stepFor(report.needed);
    const fits = step <= Number($("ram").max);
    const act = {
      label: `Take ${bytes(budgetAt(step))}`,
      run: () => {
        $("ram").value = step;
        budget();
        rebuild();
        canvas.focus();
      },
    };
    rows($("parts"), [["needed", `${count(report.needed)} B`], ["there", `${count(ram)} B`]]);
    const mailbox = ["stamps", "cache"].includes(MAILBOX[Number($("mailbox").value) - 1]);
    const whole = mailbox && kind !== undefined ? `${what}, with its mailbox,` : what;
    const text = `${whole} takes ${count(report.needed)} bytes; the budget is ${count(ram)}.`;
    say("The budget is too small", text, fits ? act : undefined);
  }

  function budget() {
    const ram = budgetAt($("ram").value);
    $("budget").textContent = bytes(ram);
    $("ram").setAttribute("aria-valuetext", bytes(ram));
  }

  // However often a slider moves, there is one build a frame.
  function change() {
    budget();
    if (!pending) pending = requestAnimationFrame(rebuild);
  }

  $("controls").addEventListener("input", change);
  $("controls").addEventListener("submit", (event) => event.preventDefault());
  $("heat").addEventListener("input", () => {
    $("legend").hidden = !$("heat").checked;
    painter.setHeat($("heat").checked);
  });
  $("nearer").addEventListener("click", () => orbit.nearer());
  $("farther").addEventListener("click", () => orbit.farther());
  $("reset").addEventListener("click", () => orbit.reset());
  budget();
  rebuild();
}

try {
  start(await Engine.load("kibiray.wasm"));
} catch (error) {
  say("The page cannot start", String(error.message ?? error));
  state("failed", "The page cannot start.");
}
