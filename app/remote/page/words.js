// Formats numbers, times and player states as text.

export const number = (value, digits) => (typeof value === "number" ? value.toFixed(digits).replace("-", "\u2212") : "\u2013");

// "1:05.3", "-0:02", "2:00:00".
export function clock(seconds, digits) {
  if (typeof seconds !== "number") {
    return "\u2013";
  }
  const rounded = Number(Math.abs(seconds).toFixed(digits));
  const whole = Math.floor(rounded);
  const [h, m, s] = [Math.floor(whole / 3600), Math.floor(whole / 60) % 60, whole % 60];
  const fraction = digits > 0 ? (rounded - whole).toFixed(digits).slice(1) : "";
  const two = (n) => String(n).padStart(2, "0");
  return `${seconds < 0 ? "\u2212" : ""}${h > 0 ? `${h}:${two(m)}` : m}:${two(s)}${fraction}`;
}

// "German" for "de".
export function languageName(tag) {
  try {
    return new Intl.DisplayNames(["en"], { type: "language" }).of(tag);
  } catch {
    return tag;
  }
}

// Describes the clock that the show follows in one line; `ago` is the time since the signal was lost, such as " 3 s ago".
export function clockText(status, ago) {
  const name = status.follows;
  switch (status.clock_state) {
    case "waiting": return `${name}: no signal yet, the show waits`;
    case "following": return status.playing ? `${name}: the show follows` : `${name}: the show follows, time is stopped`;
    case "running_on": return `${name}: signal lost${ago}, the show runs on`;
    case "stopped": return `${name}: signal lost${ago}, the show has stopped`;
    default: return "internal";
  }
}

// Announces changes to screen readers, except numbers that change all the time.
export class News {
  constructor(onNews) {
    this.onNews = onNews;
    this.told = {};
  }

  take(status) {
    const chapter = (status.chapters || [])[status.chapter];
    const news = {
      clock: `Clock: ${clockText(status, "")}`,
      playing: status.playing ? "The show is playing" : "The show is paused",
      chapter: chapter ? `Chapter: ${chapter.title}` : "",
      blackout: status.blackout ? "Blackout on" : "Blackout off",
      language: status.language ? `Language: ${languageName(status.language)}` : "",
    };
    const fresh = Object.keys(news).filter((topic) => topic in this.told && this.told[topic] !== news[topic]);
    this.told = news;
    if (fresh.length > 0) {
      this.onNews(fresh.map((topic) => news[topic]).filter(Boolean).join(". "));
    }
  }
}
