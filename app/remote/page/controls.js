// Controls that show the requested value at once, and the player's status when nobody touches them.

const trust_ms = 1500; // How long a requested value is shown while the player has not confirmed it.

// Disables a control if there is a reason; its tooltip then gives the reason.
export function allow(control, reason) {
  control.disabled = Boolean(reason);
  control.dataset.use ??= control.title;
  const title = reason ? `Unavailable: ${reason}` : control.dataset.use;
  if (control.title !== title) {
    control.title = title;
  }
}

// Keeps a requested value until the player's status confirms it.
class Wish {
  constructor() {
    this.until = 0;
  }

  make(value) {
    this.value = value;
    this.until = performance.now() + trust_ms;
  }

  // Returns the value to show: the requested one while it is recent and unconfirmed, otherwise the player's.
  settle(actual, isSame) {
    if (performance.now() < this.until && !isSame(actual, this.value)) {
      return this.value;
    }
    this.until = 0;
    return actual;
  }
}

// A toggle button; `onDraw` replaces the default display of its state.
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

// A slider that follows the finger while it is held, and the player otherwise. Sends at most one value per `interval_ms`, and always the last;
// a status within `near` of the requested value confirms it.
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

  // Requests a new value.
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
