// A canvas that is filled row by row, in slices of time that leave room for everything else.

// Milliseconds of work between two frames.
const SLICE = 14;

// Stops of the colour map "inferno" of matplotlib (S. van der Walt, N. Smith, 2015; public domain).
const INFERNO = [
  [0, 0, 4], [31, 12, 72], [85, 15, 109], [136, 34, 106], [186, 54, 85],
  [227, 89, 51], [249, 140, 10], [249, 201, 50], [252, 255, 164],
];
const PALETTE = new Uint32Array(256).map((_, i) => {
  const place = (i / 255) * (INFERNO.length - 1);
  const stop = Math.min(Math.floor(place), INFERNO.length - 2);
  const [r, g, b] = [0, 1, 2].map((channel) =>
    Math.round(INFERNO[stop][channel] + (INFERNO[stop + 1][channel] - INFERNO[stop][channel]) * (place - stop)));
  return (255 << 24) | (b << 16) | (g << 8) | r;
});

const CRC = new Uint32Array(256).map((_, i) => {
  for (let bit = 0; bit < 8; bit++) i = i & 1 ? (i >>> 1) ^ 0xedb88320 : i >>> 1;
  return i;
});

// CRC-32 of the pixels as rows of 8-bit RGB.
function crc32(rgba) {
  let crc = ~0;
  for (let i = 0; i < rgba.length; i++) {
    if ((i & 3) !== 3) crc = CRC[(crc ^ rgba[i]) & 255] ^ (crc >>> 8);
  }
  return (~crc >>> 0).toString(16).padStart(8, "0");
}

export class Painter {
  constructor(canvas, engine, events) {
    this.context = canvas.getContext("2d", { alpha: false });
    this.engine = engine;
    this.events = events;
    this.full = [canvas.width, canvas.height];
    this.heat = false;
    // What the brightest colour stands for; of the last picture until this one is done.
    this.brightest = 1;
    this.picture = null;
    this.frame = 0;
  }

  // Begins a picture seen from there: one that is done soon, or one of all pixels.
  begin(eye, quick) {
    const [width, height] = this.full.map((n) => (quick ? n / 4 : n));
    this.picture = null;
    if (!this.engine.look(eye, width, height)) return;
    const image = new ImageData(width, height);
    this.picture = { image, work: new Uint32Array(width * height), next: 0, spent: 0, quick };
    if (!this.frame) this.frame = requestAnimationFrame(() => this.slice());
  }

  stop() {
    this.picture = null;
  }

  slice() {
    this.frame = 0;
    const picture = this.picture;
    if (!picture || picture.next >= picture.image.height) return;
    const { width, height } = picture.image;
    const first = picture.next;
    const start = performance.now();
    let spent = 0;
    while (picture.next < height && spent < SLICE) {
      const { pixels, work } = this.engine.row(picture.next, width);
      picture.image.data.set(pixels, 4 * width * picture.next);
      picture.work.set(work, width * picture.next);
      picture.next += 1;
      spent = performance.now() - start;
    }
    picture.spent += spent;
    this.show(first, picture.next);
    if (picture.next < height) {
      this.frame = requestAnimationFrame(() => this.slice());
      this.events.progress(picture);
      return;
    }
    this.measure();
    if (this.heat) this.show(0, height);
    if (!picture.quick) picture.crc = crc32(picture.image.data);
    this.events.done(picture);
  }

  // Work of 999 of 1000 pixels is no greater than what is drawn brightest.
  measure() {
    const sorted = this.picture.work.slice().sort();
    this.brightest = Math.max(1, sorted[Math.floor(sorted.length * 0.999)]);
  }

  // Draws some rows. Those of a quick picture are stretched.
  show(first, end) {
    const { image, work } = this.picture;
    const { width, height } = image;
    let shown = image;
    if (this.heat) {
      shown = new ImageData(width, height);
      const colors = new Uint32Array(shown.data.buffer);
      for (let i = first * width; i < end * width; i++) {
        colors[i] = PALETTE[Math.min(255, Math.floor((work[i] / this.brightest) * 255))];
      }
    }
    if (width === this.full[0]) {
      this.context.putImageData(shown, 0, 0, 0, first, width, end - first);
      return;
    }
    this.small ??= new OffscreenCanvas(width, height);
    this.small.getContext("2d", { alpha: false }).putImageData(shown, 0, 0, 0, first, width, end - first);
    if (end === height) this.context.drawImage(this.small, 0, 0, ...this.full);
  }

  setHeat(heat) {
    this.heat = heat;
    if (this.picture) this.show(0, this.picture.next);
  }
}
