// Controls that show at once what a person asked for, and the player's status as soon as nobody touches them.

const trust_ms = 1500; // How long a person's wish is shown while the player has not confirmed it.

// Disables a control for a reason, which its tooltip gives in place of what it does.
export function allow(control, reason) {
  control.disabled = Boolean(reason);
  control.dataset.use ??= control.title;
  const title = reason ? `Not now: ${reason}` : control.dataset.use;
  if (control.title !== title) {
    control.title = title;
  }
}

// Holds a wish against an older status.
class Wish {
  constructor() {
    this.until = 0;
  }

  make(value) {
    this.value = value;
    this.until = performance.now() + trust_ms;
  }

  // What to show: the wish while it is fresh and unconfirmed, else what the player says.
  settle(actual, isSame) {
    if (performance.now() < this.until && !isSame(actual, this.value)) {
      return this.value;
    }
    this.until = 0;
    return actual;
  }
}

// A button that is lit or not; `onDraw` instead of the lighting where it says what it will do.
export class Toggle {
  constructor(button, onChange, onDraw = (lit) => button.setAttribute("aria-pressed", String(lit))) {
    this.onDraw = onDraw;
    this.wish = new Wish();
    button.addEventListener("click", () => {
      this.wish.make(!this.isLit);
      this.draw(!this.isLit);
      onChange(this.isLit);
    });
  }

  draw(lit) {
    this.isLit = lit;
    this.onDraw(lit);
  }

  show(actual) {
    this.draw(this.wish.settle(actual, (a, b) => a === b));
  }
}

// A range that follows the finger while it is held, and the player else. Sends at most one value per `interval_ms`, and always the last;
// a status that is `near` a wish confirms it.
export class Fader {
  constructor(input, { onChange, onDraw, interval_ms = 100, near = Number(input.step) }) {
    Object.assign(this, { input, onChange, onDraw, interval_ms, near });
    this.wish = new Wish();
    this.held = false;
    this.lastSent = -Infinity;
    input.addEventListener("pointerdown", () => { this.held = true; });
    for (const end of ["pointerup", "pointercancel", "lostpointercapture", "blur"]) {
      input.addEventListener(end, () => { this.held = false; });
    }
    input.addEventListener("input", () => this.change(Number(input.value)));
  }

  // A person's new value.
  change(value) {
    this.wish.make(value);
    this.draw(value);
    this.sendSoon();
  }

  sendSoon() {
    if (this.timer === undefined) {
      const wait_ms = Math.max(0, this.lastSent + this.interval_ms - performance.now());
      this.timer = setTimeout(() => {
        this.timer = undefined;
        this.lastSent = performance.now();
        this.onChange(this.wish.value);
      }, wait_ms);
    }
  }

  draw(value) {
    this.input.value = value;
    this.onDraw(value, this.input);
  }

  show(actual) {
    if (this.held || this.timer !== undefined || typeof actual !== "number") {
      return;
    }
    this.draw(this.wish.settle(actual, (a, b) => Math.abs(a - b) <= this.near));
  }
}
