// The operator's page: shows the player's status and sends the operator's commands.

import { Connection } from "./connection.js";
import { allow, Fader, Toggle } from "./controls.js";
import { FrameGraph } from "./graph.js";
import { clock, clockText, languageName, News, number } from "./words.js";

const most_log_lines = 300;
const refused_ms = 5000;

const find = (id) => document.getElementById(id);
const put = (element, text) => {
  // Writes only changes, so that screen readers and text selections are not disturbed.
  if (element.textContent !== text) {
    element.textContent = text;
  }
};
const make = (tag, text = "", className = "") => Object.assign(document.createElement(tag), { textContent: text, className });

let status = {};
let refusedTimer;

function showRefused(text) {
  const line = find("refused");
  line.hidden = false;
  put(line, text);
  clearTimeout(refusedTimer);
  refusedTimer = setTimeout(() => { line.hidden = true; }, refused_ms);
}

function showState(isConnected) {
  document.body.classList.remove("waiting");
  document.body.classList.toggle("lost", !isConnected);
  put(find("connection"), isConnected ? "Connected" : "Connection lost, reconnecting");
}

const connection = new Connection({ onStatus: takeStatus, onLog: showLog, onState: showState, onRefused: showRefused });
const send = (kind, argument) => connection.send(kind, argument);

// Transport ---------------------------------------------------------------------------------------------------------------------------

const playing = new Toggle(find("toggle_pause"), (on) => send(on ? "play" : "pause"), (on) => {
  // The label names what a press does.
  put(find("toggle_pause"), on ? "Pause" : "Play");
  find("toggle_pause").setAttribute("aria-label", on ? "Pause" : "Play");
});
const toggles = {
  loop: new Toggle(find("loop"), (on) => send("loop", { value: on })),
  captions: new Toggle(find("captions"), (on) => send("captions", { value: on })),
  blackout: new Toggle(find("blackout"), (on) => send("blackout", { value: on })),
  free_flight: new Toggle(find("free_flight"), (on) => send(on ? "free_flight" : "return")),
};

for (const kind of ["previous_chapter", "next_chapter", "reset", "reload"]) {
  find(kind).addEventListener("click", () => send(kind));
}
find("step_back").addEventListener("click", () => send("step", { value: -1 }));
find("step_on").addEventListener("click", () => send("step", { value: 1 }));
for (const button of document.querySelectorAll("[data-speed]")) {
  button.addEventListener("click", () => send("speed", { value: Number(button.dataset.speed) }));
}

const seek = new Fader(find("seek"), {
  interval_ms: 200,
  near: 0.5,
  onChange: (value) => send("seek", { value }),
  onDraw: (value, input) => {
    put(find("time"), clock(value, 1));
    put(find("remaining"), clock(Math.max(0, status.duration_s - value), 0));
    input.setAttribute("aria-valuetext", `${clock(value, 0)} of ${clock(status.duration_s, 0)}`);
  },
});
// Arrow keys move by seconds; the slider's own steps are 0.1 s.
find("seek").addEventListener("keydown", (event) => {
  const by = { ArrowRight: 1, ArrowUp: 1, ArrowLeft: -1, ArrowDown: -1, PageUp: 10, PageDown: -10 }[event.key];
  if (by !== undefined) {
    event.preventDefault();
    const input = event.target;
    seek.change(Math.min(Number(input.max), Math.max(0, Number(input.value) + by)));
  }
});

document.addEventListener("keydown", (event) => {
  const isFree = !event.ctrlKey && !event.altKey && !event.metaKey && !event.target.closest("button, input");
  if (event.key === " " && isFree) {
    event.preventDefault();
    find("toggle_pause").click();
  }
});

// Faders ------------------------------------------------------------------------------------------------------------------------------

const units = {
  exposure: (value) => `${value > 0 ? "+" : ""}${number(value, 1)} EV`,
  baseline: (value) => {
    const inMasses = (distance) => `${number(distance, distance < 1 ? 3 : 1)} M`;
    // The player reduces the baseline if it does not fit.
    const isNarrowed = status.stereo && value === status.baseline && status.baseline_used < value;
    return isNarrowed ? `${inMasses(value)} (max ${inMasses(status.baseline_used)})` : inMasses(value);
  },
  volume: (value) => `${number(100 * value, 0)} %`,
};
const faders = {};
for (const [kind, text] of Object.entries(units)) {
  faders[kind] = new Fader(find(kind), {
    onChange: (value) => send(kind, { value }),
    onDraw: (value, input) => {
      put(find(`${kind}-value`), text(value));
      input.setAttribute("aria-valuetext", text(value));
    },
  });
}
for (const button of document.querySelectorAll("[data-home]")) {
  button.addEventListener("click", () => faders[button.dataset.home].change(Number(button.dataset.value)));
}

let loudness = 1; // The volume that Mute restores.
const mute = new Toggle(find("mute"), (on) => faders.volume.change(on ? 0 : loudness));

// Rebuilds a list only when its content has changed, so that a list stays in place while it is touched.
function rebuild(list, content, makeItems) {
  const key = JSON.stringify(content);
  if (list.dataset.key !== key) {
    list.dataset.key = key;
    list.replaceChildren(...makeItems());
  }
}

function showLanguages() {
  const languages = status.languages || [];
  const list = find("languages");
  find("language-row").hidden = languages.length < 2;
  rebuild(list, languages, () => languages.map((tag) => {
    const button = make("button", tag);
    button.type = "button";
    button.title = languageName(tag);
    button.addEventListener("click", () => send("language", { text: tag }));
    return button;
  }));
  for (const button of list.children) {
    button.setAttribute("aria-pressed", String(button.textContent === status.language));
  }
}

function showChapters() {
  const chapters = status.chapters || [];
  find("no-chapters").hidden = chapters.length > 0;
  rebuild(find("chapters"), chapters, () => chapters.map((chapter, index) => {
    const button = make("button");
    button.type = "button";
    button.append(make("span", clock(chapter.time_s, 0)), chapter.title || `Chapter ${index + 1}`);
    button.title = `Go to ${clock(chapter.time_s, 0)}`;
    button.dataset.kind = "chapter";
    button.addEventListener("click", () => send("chapter", { value: index }));
    const item = make("li");
    item.append(button);
    return item;
  }));
  [...find("chapters").children].forEach((item, index) => {
    item.firstChild.toggleAttribute("aria-current", index === status.chapter);
  });
  rebuild(find("marks"), [chapters, status.duration_s], () => chapters.map((chapter) => {
    const mark = make("i");
    mark.style.left = `${(100 * chapter.time_s) / (status.duration_s || 1)}%`;
    return mark;
  }));
}

function showPads() {
  const pads = status.pads || [];
  find("no-pads").hidden = pads.length > 0;
  rebuild(find("pads"), pads.map((pad) => [pad.name, pad.connection]), () => pads.map((pad) => {
    const item = make("li");
    item.append(make("span", pad.name || "Unknown pad"), make("span", "", "word"), make("span", pad.connection, "by"));
    return item;
  }));
  [...find("pads").children].forEach((item, index) => {
    item.classList.toggle("active", pads[index].active);
    put(item.querySelector(".word"), pads[index].active ? "in use" : "");
  });
}

const graph = new FrameGraph(find("graph"));
const news = new News((text) => put(find("news"), text));

function showFrames() {
  put(find("frame_ms"), number(status.frame_ms, 1));
  put(find("worst_frame_ms"), number(status.worst_frame_ms, 1));
  put(find("dropped_frames"), String(status.dropped_frames));
  graph.add(status.frame_ms);
  graph.draw();
  const facts = [["Observer", status.observer], ["Lens", status.lens], ["Backend", status.backend], [status.nodes && status.nodes.length > 0 ? "Nodes" : "Headset", status.display], ["Sound", status.sound]];
  rebuild(find("facts"), facts, () => facts.filter(([, fact]) => fact).flatMap(([name, fact]) => [make("dt", name), make("dd", fact)]));
}

function showTransport() {
  put(find("title"), status.title || "Ergodome");
  playing.show(status.playing);
  for (const [kind, toggle] of Object.entries(toggles)) {
    toggle.show(status[kind]);
  }
  const bar = find("seek");
  bar.max = status.duration_s || 1;
  find("rest").hidden = !(status.duration_s > 0);
  put(find("duration"), clock(status.duration_s, 0));
  put(find("mode"), status.free_flight ? "free flight" : "");
  seek.show(status.time_s);
  put(find("speed"), number(status.speed, 2).replace(/\.?0+$/, ""));
  for (const button of document.querySelectorAll("[data-speed]")) {
    button.setAttribute("aria-pressed", String(Number(button.dataset.speed) === status.speed));
  }
}

function showClock() {
  const line = find("clock");
  put(line, clockText(status, ` ${number(status.clock_silence_s, 0)} s ago`));
  find("clock-line").classList.toggle("alarm", ["waiting", "running_on", "stopped"].includes(status.clock_state));
}

// Disables controls whose commands the player would refuse; their tooltips give the reason.
function showRefusals() {
  const refused = status.refused || {};
  const still = !(status.duration_s > 0) && "this show has no duration";
  const flying = status.free_flight && "the camera has left the show's path; end free flight first";
  const reasons = {
    seek: refused.seek || still || flying, toggle_pause: refused.toggle_pause, previous_chapter: refused.previous_chapter,
    next_chapter: refused.next_chapter, step_back: refused.step, step_on: refused.step,
    baseline: !status.stereo && "the show is not in stereo",
  };
  for (const [id, reason] of Object.entries(reasons)) {
    allow(find(id), reason);
  }
  allow(document.querySelector("[data-home='baseline']"), reasons.baseline);
  for (const button of document.querySelectorAll("[data-speed]")) {
    allow(button, refused.speed);
  }
  for (const button of document.querySelectorAll("#chapters button")) {
    allow(button, refused.chapter);
  }
}

function showFaders() {
  // Extends the slider's range when the baseline exceeds it.
  const baseline = find("baseline");
  if (status.baseline > Number(baseline.max)) {
    baseline.max = 2 * status.baseline;
    baseline.step = baseline.max / 200;
  }
  faders.exposure.show(status.exposure_stops);
  faders.baseline.show(status.baseline);
  faders.volume.show(status.volume);
  mute.show(status.volume === 0);
  loudness = status.volume || loudness;
}

function takeStatus(fresh) {
  status = fresh;
  showTransport();
  showFaders();
  showLanguages();
  showChapters();
  showPads();
  showFrames();
  showClock();
  showRefusals();
  news.take(status);
  find("problem").hidden = !status.problem;
  put(find("problem"), status.problem || "");
}

function showLog(lines) {
  const list = find("log");
  const isAtEnd = list.scrollTop + list.clientHeight >= list.scrollHeight - 8;
  for (const line of lines) {
    const item = make("li", "", line.level);
    item.append(make("time", new Date(line.time_ms).toLocaleTimeString([], { hour12: false })), line.text);
    list.append(item);
  }
  while (list.children.length > most_log_lines) {
    list.firstChild.remove();
  }
  if (isAtEnd) {
    list.scrollTop = list.scrollHeight;
  }
}
