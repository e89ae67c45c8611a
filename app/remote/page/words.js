// Numbers, times and states of the player in words.

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

// What the show's time follows, and how long ago that was lost, as one line; `ago` is " 3 s ago".
export function clockText(status, ago) {
  const name = status.follows;
  switch (status.clock_state) {
    case "waiting": return `${name}: not heard yet, the show waits`;
    case "following": return status.playing ? `${name}: the show follows` : `${name}: it stands still`;
    case "running_on": return `${name}: lost${ago}, running on its own clock`;
    case "stopped": return `${name}: lost${ago}, the show has stopped`;
    default: return "own";
  }
}

// Tells screen readers of changes that the page shows elsewhere. Numbers that run are left out.
export class News {
  constructor(onNews) {
    this.onNews = onNews;
    this.told = {};
  }

  take(status) {
    const chapter = (status.chapters || [])[status.chapter];
    const news = {
      clock: `Clock: ${clockText(status, "")}`,
      playing: status.playing ? "The show plays" : "The show is paused",
      chapter: chapter ? `Chapter: ${chapter.title}` : "",
      blackout: status.blackout ? "Blackout" : "No blackout",
      language: status.language ? `Language: ${languageName(status.language)}` : "",
    };
    const fresh = Object.keys(news).filter((topic) => topic in this.told && this.told[topic] !== news[topic]);
    this.told = news;
    if (fresh.length > 0) {
      this.onNews(fresh.map((topic) => news[topic]).filter(Boolean).join(". "));
    }
  }
}
