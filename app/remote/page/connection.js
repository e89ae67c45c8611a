// Receives events from the player and sends commands. Reconnects automatically.

const silence_ms = 2500; // Status arrives ten times a second; after this long without one the connection counts as lost.
const retry_ms = 1000;

export class Connection {
  constructor({ onStatus, onLog, onState, onRefused }) {
    Object.assign(this, { onStatus, onLog, onState, onRefused });
    this.lastLine = 0;
    this.open();
  }

  open() {
    this.source = new EventSource("api/events");
    this.source.addEventListener("status", (event) => {
      this.watch();
      this.onState(true);
      this.onStatus(JSON.parse(event.data));
    });
    this.source.addEventListener("log", (event) => this.takeLines(JSON.parse(event.data)));
    this.source.onerror = () => this.lose();
    this.watch();
  }

  // A new stream repeats lines that are already shown; a restarted player counts from one again.
  takeLines(lines) {
    if (lines.length > 0 && lines[lines.length - 1].number < this.lastLine) {
      this.lastLine = 0;
    }
    const fresh = lines.filter((line) => line.number > this.lastLine);
    if (fresh.length > 0) {
      this.lastLine = fresh[fresh.length - 1].number;
      this.onLog(fresh);
    }
  }

  watch() {
    clearTimeout(this.watchdog);
    this.watchdog = setTimeout(() => this.lose(), silence_ms);
  }

  lose() {
    clearTimeout(this.watchdog);
    clearTimeout(this.retry);
    this.source.close();
    this.onState(false);
    this.retry = setTimeout(() => this.open(), retry_ms);
  }

  async send(kind, argument = {}) {
    try {
      const answer = await fetch("api/command", {
        method: "POST",
        headers: { "Content-Type": "application/json" },
        body: JSON.stringify({ kind, ...argument }),
        signal: AbortSignal.timeout(3000),
      });
      if (!answer.ok) {
        const text = await answer.json().catch(() => ({}));
        this.onRefused(text.error || `The player refused the command (HTTP ${answer.status}).`);
      }
    } catch (error) {
      this.onRefused("The player does not answer.");
    }
  }
}
