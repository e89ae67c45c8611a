// Frame times of the last minute.

const minute_ms = 60000;

export class FrameGraph {
  constructor(canvas) {
    this.canvas = canvas;
    this.samples = []; // { at, ms }
  }

  add(ms) {
    const now = performance.now();
    if (typeof ms === "number") {
      this.samples.push({ at: now, ms });
    }
    while (this.samples.length > 0 && this.samples[0].at < now - minute_ms) {
      this.samples.shift();
    }
  }

  // Returns the top of the scale: two frames at 60 Hz, doubled until all samples fit.
  top() {
    let top = 1000 / 30;
    const most = Math.max(0, ...this.samples.map((sample) => sample.ms));
    while (top < most) {
      top *= 2;
    }
    return top;
  }

  draw() {
    const { canvas } = this;
    const ratio = window.devicePixelRatio || 1;
    const [width, height] = [canvas.clientWidth, canvas.clientHeight];
    canvas.width = Math.round(width * ratio);
    canvas.height = Math.round(height * ratio);
    const pen = canvas.getContext("2d");
    pen.scale(ratio, ratio);
    const top = this.top();
    const y = (ms) => height - 3 - (ms / top) * (height - 6);
    this.drawScale(pen, width, y, top);
    this.drawLine(pen, width, y);
  }

  drawScale(pen, width, y, top) {
    pen.strokeStyle = "#4a2721";
    pen.fillStyle = "#a8705f";
    pen.font = "11px DejaVu Sans, sans-serif";
    for (const ms of [top, top / 2]) {
      pen.beginPath();
      pen.moveTo(0, y(ms));
      pen.lineTo(width, y(ms));
      pen.stroke();
      pen.fillText(`${ms.toFixed(0)} ms`, 4, y(ms) + 12);
    }
  }

  drawLine(pen, width, y) {
    const now = performance.now();
    pen.strokeStyle = "#ff8a66";
    pen.lineWidth = 1.5;
    pen.beginPath();
    this.samples.forEach((sample, i) => {
      const x = width * (1 - (now - sample.at) / minute_ms);
      // Leaves a gap in the line where no status arrived.
      const isGap = i === 0 || sample.at - this.samples[i - 1].at > 2500;
      pen[isGap ? "moveTo" : "lineTo"](x, y(sample.ms));
    });
    pen.stroke();
  }
}
