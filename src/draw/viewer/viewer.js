// The viewer of pages: a mesh that turns, that a plane cuts, and that tells the cell, its weights and the value where it
// is clicked. THREE is three.js, of data/viewer. In the scene the box of the mesh has its middle at 0, its longest side
// is 2.
"use strict";

/// Doubles as integers times a common power of two: numbers[i] = all[i] * 2^exponent.
function integers(numbers) {
  const view = new DataView(new ArrayBuffer(8));
  const parts = numbers.map((x) => {
    view.setFloat64(0, x);
    const bits = view.getBigUint64(0), power = Number((bits >> 52n) & 0x7ffn);
    const size = (bits & 0xfffffffffffffn) | (power > 0 ? 1n << 52n : 0n);
    return [bits >> 63n ? -size : size, Math.max(power, 1)];
  });
  const least = Math.min(...parts.map((p) => p[1]));
  return { all: parts.map(([size, power]) => size << BigInt(power - least)), exponent: least - 1075 };
}

/// The double nearest to n / d * 2^exponent, ties to even: of one that is not subnormal.
function nearest(n, d, exponent = 0) {
  const [a, b] = [n < 0n ? -n : n, d < 0n ? -d : d];
  const shift = 68 + 4 * (b.toString(16).length - a.toString(16).length);  // a quotient of 65 bits or more
  const [over, under] = shift > 0 ? [a << BigInt(shift), b] : [a, b << BigInt(-shift)];
  const whole = Number((over / under) | (over % under === 0n ? 0n : 1n));
  const power = exponent - shift, half = Math.trunc(power / 2);
  return (n < 0n === d < 0n || n === 0n ? whole : -whole) * 2 ** half * 2 ** (power - half);
}

function determinant(rows) {
  if (rows.length === 2) return rows[0][0] * rows[1][1] - rows[0][1] * rows[1][0];
  const [a, b, c] = rows;
  return a[0] * (b[1] * c[2] - b[2] * c[1]) - a[1] * (b[0] * c[2] - b[2] * c[0]) + a[2] * (b[0] * c[1] - b[1] * c[0]);
}

/// The weights of a point in a simplex, exactly: numerators and their denominator; nothing if it is degenerate.
function exactWeights(corners, point) {
  const d = corners.length - 1;
  const { all } = integers([...corners, point].flatMap((p) => p.slice(0, d)));
  const from = (i) => Array.from({ length: d }, (_, k) => all[d * i + k] - all[k]);
  const edges = Array.from({ length: d }, (_, i) => from(i + 1)), to = from(d + 1);
  const whole = determinant(edges);
  if (whole === 0n) return null;
  const numerators = edges.map((_, i) => determinant(edges.map((edge, j) => (i === j ? to : edge))));
  return { numerators: [numerators.reduce((left, n) => left - n, whole), ...numerators], denominator: whole };
}

/// The header, in JSON, and its arrays behind it, each at a multiple of 8 bytes.
function unpacked(buffer) {
  const length = new Uint32Array(buffer, 0, 1)[0], types = { f8: Float64Array, f4: Float32Array, i4: Int32Array };
  const header = JSON.parse(new TextDecoder().decode(new Uint8Array(buffer, 4, length)));
  let at = 8 * Math.ceil((4 + length) / 8);
  header.arrays = header.arrays.map(([type, count]) => {
    const numbers = new types[type](buffer, at, count);
    at += 8 * Math.ceil(numbers.byteLength / 8);
    return numbers;
  });
  return header;
}

/// Fields by their components.
function choicesOf(data) {
  return data.fields.flatMap((field, of) => {
    const values = data.arrays[field.values], c = field.components;
    return Array.from({ length: c }, (_, k) => ({
      ...field, of, name: c === 1 ? field.name : `${field.name}.${k}`, rows: values.length / c, at: (i) => values[c * i + k] }));
  });
}

class Viewer {
  constructor(figure, buffer) {
    this.figure = figure;
    const data = (this.data = unpacked(buffer));
    this.points = data.arrays[data.points];
    this.cells = data.arrays[data.cells];
    this.corners = data.dimension + 1;
    this.choices = choicesOf(data);
    this.choice = this.choices.find((c) => c.of === data.field) || null;
    this.surfaces = data.surfaces.map((s) => this.surfaceOf(s));
    this.renderer = new THREE.WebGLRenderer({ antialias: true, alpha: true, preserveDrawingBuffer: true });
    this.layOut();
    this.renderer.localClippingEnabled = true;
    this.renderer.domElement.tabIndex = 0;  // keys
    this.stage.append(this.renderer.domElement);
    this.scene = new THREE.Scene();
    this.scene.add(new THREE.AmbientLight(0xffffff, 1.3));
    this.light = new THREE.DirectionalLight(0xffffff, 2.2);  // from the upper left behind the camera
    this.light.position.set(-1, 1, 2);
    this.addLines();
    this.setCamera();
    this.colour();
    new ResizeObserver(() => this.resize()).observe(this.stage);
    addEventListener("resize", () => this.resize());
    for (const what of ["(prefers-color-scheme: dark)", "print"]) matchMedia(what).addEventListener("change", () => this.draw());
    this.renderer.domElement.addEventListener("pointerdown", (e) =>
      (this.down = e.isPrimary && e.button === 0 ? [e.clientX, e.clientY] : null));
    this.renderer.domElement.addEventListener("pointerup", (e) => {
      if (this.down && Math.hypot(e.clientX - this.down[0], e.clientY - this.down[1]) < 5) this.pick(e.clientX, e.clientY);
    });
    this.resize();
  }

  /// Triangles with, for each of their points, the ends of an edge of the mesh and where on it the point is.
  surfaceOf(s) {
    const ends = this.data.arrays[s.ends], own = s.points === undefined ? null : this.data.arrays[s.points];
    const at = (v) => (own ? own.subarray(3 * v, 3 * v + 3) : this.node(ends[2 * v]));
    const part = (v) => {
      const [a, b] = [this.node(ends[2 * v]), this.node(ends[2 * v + 1])], p = at(v);
      const k = [0, 1, 2].reduce((best, i) => (Math.abs(b[i] - a[i]) > Math.abs(b[best] - a[best]) ? i : best), 0);
      return a[k] === b[k] ? 0 : (p[k] - a[k]) / (b[k] - a[k]);
    };
    return { ...s, triangles: this.data.arrays[s.triangles], cells: this.data.arrays[s.cells], at, ends, part };
  }

  node(i) {
    return this.points.subarray(3 * i, 3 * i + 3);
  }
  placed(p) {
    return [0, 1, 2].map((k) => p[k] / this.data.half - this.data.middle[k] / this.data.half);
  }

  /// The controls above the stage, the colour bar below it, and what a click tells; the still picture goes.
  layOut() {
    const { data } = this, all = document.createElement("div");
    all.innerHTML = `<div class="tools"><label>Field <select name="field"></select></label>
<label>Cut <select name="side"></select></label><input type="range" name="where" max="1000" value="500" aria-label="where the plane cuts"/>
<label><input type="checkbox" name="edges" checked=""/> lines</label><label><input type="checkbox" name="through"/> see through</label>
<button type="button">Reset</button></div><div class="stage"></div><div class="bar"></div><output class="said"></output>`;
    for (const part of all.querySelectorAll("[name]")) this[part.name] = part;
    for (const name of ["stage", "bar", "said"]) this[name] = all.querySelector("." + name);
    this.field.append(...["none", ...this.choices.map((c) => c.name)].map((text) => new Option(text)));
    this.field.selectedIndex = this.choices.indexOf(this.choice) + 1;
    this.side.append(...["none", "x", "-x", "y", "-y", "z", "-z"].map((text) => new Option(text)));
    this.through.checked = data.seeThrough;
    this.field.parentElement.hidden = !this.choices.length;
    this.side.parentElement.hidden = this.where.hidden = this.corners === 3;
    this.edges.parentElement.hidden = !data.lines.length;
    this.through.parentElement.hidden = !data.surfaces.some((s) => s.clear);
    this.field.addEventListener("change", () => {
      this.choice = this.choices[this.field.selectedIndex - 1] || null;
      this.colour();
      if (this.picked) this.tell();
    });
    this.side.addEventListener("change", () => this.cut());
    this.where.addEventListener("input", () => this.cut());
    this.edges.addEventListener("change", () => this.draw());
    this.through.addEventListener("change", () => this.colour());
    all.querySelector("button").addEventListener("click", () => this.setCamera());
    this.labels = data.labels.map(({ at, text, bad }) => {
      const shown = Object.assign(document.createElement("span"), { textContent: text, className: bad ? "bad" : "" });
      this.stage.append(shown);
      return { at, shown };
    });
    const hint = `Drag to ${this.corners === 3 ? "move" : "turn"} it; click for a cell, its exact weights and value. Arrow keys move${this.corners === 3 ? "" : ", with shift they turn"}.`;
    this.said.textContent = [hint, ...data.told].join(" ");
    this.figure.querySelector(".still").replaceWith(...all.children);
  }

  setCamera() {
    const { azimuth, elevation, zoom, parallel } = this.data.camera, plane = this.corners === 3;
    const [a, e] = [(azimuth * Math.PI) / 180, (Math.max(-89.99, Math.min(elevation, 89.99)) * Math.PI) / 180];
    const direction = plane ? [0, 0, 1] : [Math.cos(e) * Math.cos(a), Math.cos(e) * Math.sin(a), Math.sin(e)];
    if (this.camera) {
      this.scene.remove(this.camera);
      this.controls.dispose();
    }
    this.camera = parallel || plane ? new THREE.OrthographicCamera() : new THREE.PerspectiveCamera(30);
    this.camera.up.set(...(plane ? [0, 1, 0] : [0, 0, 1]));
    this.reach = Math.hypot(...this.data.sides) / 2;
    const away = this.reach / Math.sin(Math.PI / 12);
    this.camera.position.set(...direction.map((x) => x * away));
    Object.assign(this.camera, { near: away / 100, far: 10 * away });
    this.camera.add(this.light, this.light.target);
    this.scene.add(this.camera);
    this.controls = new THREE.OrbitControls(this.camera, this.renderer.domElement);
    // In the plane what turns in space moves.
    if (plane) Object.assign(this.controls, { enableRotate: false, mouseButtons: { LEFT: 2, MIDDLE: 1, RIGHT: 2 }, touches: { ONE: 1, TWO: 2 } });
    this.controls.listenToKeyEvents(this.renderer.domElement);
    this.controls.addEventListener("change", () => this.draw());
    this.resize();
    this.camera.zoom = (0.96 * zoom) / this.extent();  // what is in sight fills the stage
    this.resize();
  }

  /// How far the corners of the box are from the middle of the stage, which ends at 1.
  extent() {
    this.camera.lookAt(0, 0, 0);
    this.camera.updateMatrixWorld();
    const half = this.data.sides.map((side) => side / 2);
    return Math.max(...Array.from({ length: 8 }, (_, i) => {
      const corner = new THREE.Vector3(...half.map((h, k) => ((i >> k) & 1 ? h : -h))).project(this.camera);
      return Math.max(Math.abs(corner.x), Math.abs(corner.y));
    }));
  }

  resize() {
    const width = Math.max(this.stage.clientWidth, 1), height = Math.round(Math.min(0.72 * width, 0.8 * innerHeight));
    const aspect = width / height, r = this.reach / Math.min(aspect, 1);
    if (this.camera.isPerspectiveCamera) this.camera.aspect = aspect;
    else Object.assign(this.camera, { left: -r * aspect, right: r * aspect, top: r, bottom: -r });
    this.camera.updateProjectionMatrix();
    this.renderer.setPixelRatio(Math.min(devicePixelRatio, 2));
    this.renderer.setSize(width, height, false);
    this.draw();
  }

  addLines() {
    this.lines = this.data.lines.map((l) => {
      const geometry = new THREE.BufferGeometry();
      geometry.setAttribute("position", new THREE.BufferAttribute(this.data.arrays[l.points], 3));
      geometry.setIndex(new THREE.BufferAttribute(new Uint32Array(this.data.arrays[l.segments]), 1));
      return new THREE.LineSegments(geometry, new THREE.LineBasicMaterial());
    });
    this.scene.add(...this.lines, (this.mark = new THREE.LineSegments()));
    this.mark.material = new THREE.LineBasicMaterial({ color: 0xe0103a, depthTest: false });
  }

  /// The field's value at a point of a surface, which is on an edge of the mesh.
  valueAt(surface, vertex, cell) {
    if (!this.choice) return NaN;
    if (this.choice.ofCells) return this.choice.at(cell);
    const [a, b] = [0, 1].map((k) => this.choice.at(surface.ends[2 * vertex + k]));
    return surface.ends[2 * vertex] === surface.ends[2 * vertex + 1] ? a : a + surface.part(vertex) * (b - a);
  }

  /// The meshes of three.js, in the colours of the field that is chosen.
  colour() {
    const { data } = this;
    const given = this.choice && this.choice.of === data.field ? data.range : null;
    let low = Infinity, high = -Infinity;
    for (let i = 0; this.choice && i < this.choice.rows; ++i) {
      const x = this.choice.at(i);
      if (Number.isFinite(x) && (!data.log || x > 0)) [low, high] = [Math.min(low, x), Math.max(high, x)];
    }
    [this.low, this.high] = given || [low, high];
    const pixels = new Uint8Array(4 * 512);
    for (let i = 0; i < 256; ++i) {
      pixels.set([...data.map.slice(3 * i, 3 * i + 3), 255], 4 * i);
      pixels.set([...(this.choice ? [150, 150, 150] : [200, 204, 208]), 255], 4 * (256 + i));
    }
    if (this.map) this.map.dispose();
    this.map = new THREE.DataTexture(pixels, 256, 2);
    this.map.colorSpace = THREE.SRGBColorSpace;
    this.map.needsUpdate = true;
    for (const s of this.surfaces) {
      this.drop(s.mesh);
      const numbers = s.triangles.length, corners = { positions: new Float32Array(3 * numbers), uv: new Float32Array(2 * numbers) };
      for (let i = 0; i < numbers; ++i) corners.positions.set(this.placed(s.at(s.triangles[i])), 3 * i);
      for (let i = 0; i < numbers; i += 3)
        corners.uv.set(this.place([0, 1, 2].map((k) => this.valueAt(s, s.triangles[i + k], s.cells[i / 3]))), 2 * i);
      s.mesh = this.meshOf(corners, s);
      this.scene.add(s.mesh);
    }
    this.showBar();
    this.cut();
  }

  drop(mesh) {
    if (!mesh) return;
    this.scene.remove(mesh);
    for (const part of [mesh.geometry, mesh.material]) part.dispose();
  }

  /// Where values are in the texture: along the colours, or in the row for none, if one has none.
  place(values) {
    const f = this.data.log ? Math.log : (y) => y, [low, high, ...all] = [this.low, this.high, ...values].map(f);
    if (!all.every(Number.isFinite)) return all.flatMap(() => [0.5, 0.75]);
    return all.flatMap((y) => [high > low ? Math.max(0, Math.min((y - low) / (high - low), 1)) : 0.5, 0.25]);
  }

  meshOf({ positions, uv }, { colour, clear }) {
    const geometry = new THREE.BufferGeometry();
    geometry.setAttribute("position", new THREE.BufferAttribute(positions, 3));
    geometry.setAttribute("uv", new THREE.BufferAttribute(uv, 2));
    const back = colour ? 0 : 1;  // behind lines, and behind what has a colour of its own
    const look = { side: THREE.DoubleSide, polygonOffset: true, polygonOffsetFactor: back, polygonOffsetUnits: back };
    if (clear && this.through.checked) Object.assign(look, { transparent: true, opacity: 0.3, depthWrite: false });
    Object.assign(look, colour ? { color: new THREE.Color(`rgb(${colour.slice(0, 3)})`) } : { map: this.map });
    const Material = this.corners === 3 ? THREE.MeshBasicMaterial : THREE.MeshLambertMaterial;
    return new THREE.Mesh(geometry, new Material({ ...look, ...(this.corners === 3 ? {} : { flatShading: true }) }));
  }

  showBar() {
    this.bar.hidden = !this.choice;
    if (!this.choice) return;
    const text = (x) => String(Number(x.toPrecision(4))).replace("-", "\u2212");
    const at = (t) => (this.data.log ? this.low * (this.high / this.low) ** t : this.low + t * (this.high - this.low));
    const stops = Array.from({ length: 16 }, (_, i) => `rgb(${this.data.map.slice(51 * i, 51 * i + 3)})`);
    this.bar.innerHTML = `<p></p><div style="background:linear-gradient(to right,${stops})"></div>
<p>${(this.low <= this.high ? [0, 0.5, 1] : []).map((t) => `<span>${text(at(t))}</span>`).join("")}</p>`;
    this.bar.firstChild.textContent = this.choice.name + (this.choice.unit ? ` (${this.choice.unit})` : "");
  }

  /// By the plane, what is before it goes; cells that are there as a whole show their section.
  cut() {
    if (this.section) this.drop(this.section.mesh);
    this.section = this.plane = null;
    const name = this.side.value, k = "xyz".indexOf(name.at(-1));
    if (name !== "none") {
      const sign = name[0] === "-" ? -1 : 1, side = this.data.sides[k];
      this.offset = (this.where.value / 1000 - 0.5) * side;
      this.plane = new THREE.Plane(new THREE.Vector3().setComponent(k, -sign), sign * this.offset);
      if (this.data.whole) this.addSection(k);
    }
    for (const s of this.surfaces) s.mesh.material.clippingPlanes = this.plane ? [this.plane] : [];
    for (const l of this.lines) l.material.clippingPlanes = this.plane ? [this.plane] : [];
    this.draw();
  }

  addSection(k) {
    const x = this.data.middle[k] + this.offset * this.data.half;
    const positions = [], uv = [], owners = [];
    for (let cell = 0; cell < this.cells.length / 4; ++cell) {
      const nodes = Array.from(this.cells.subarray(4 * cell, 4 * cell + 4));
      const [inside, outside] = [nodes.filter((n) => this.points[3 * n + k] >= x), nodes.filter((n) => this.points[3 * n + k] < x)];
      if (!inside.length || !outside.length) continue;
      const ring = inside.flatMap((a, i) => (i ? outside.slice().reverse() : outside).map((b) => {
        const t = (x - this.points[3 * a + k]) / (this.points[3 * b + k] - this.points[3 * a + k]);
        const mixed = (f) => f(a) + t * (f(b) - f(a));
        const value = !this.choice ? NaN : this.choice.ofCells ? this.choice.at(cell) : mixed(this.choice.at);
        return { at: [0, 1, 2].map((j) => mixed((n) => this.points[3 * n + j])), value };
      }));
      for (let i = 1; i + 1 < ring.length; ++i) {
        const three = [ring[0], ring[i], ring[i + 1]];
        positions.push(...three.flatMap((p) => this.placed(p.at)));
        uv.push(...this.place(three.map((p) => p.value)));
        owners.push({ cell, corners: three.map((p) => p.at) });
      }
    }
    const mesh = this.meshOf({ positions: new Float32Array(positions), uv: new Float32Array(uv) }, {});
    this.section = { mesh, owners };
    this.scene.add(mesh);
  }

  draw() {
    const ink = new THREE.Color(getComputedStyle(this.figure).color);
    for (const l of this.lines) {
      l.visible = this.edges.checked;
      l.material.color = ink;
    }
    this.renderer.render(this.scene, this.camera);
    for (const { at, shown } of this.labels) {
      const [x, y] = this.partsOf(at);
      Object.assign(shown.style, { left: `${100 * x}%`, top: `${100 * y}%` });
    }
  }

  /// What is at a pixel of the window: the cell in front, and the point of it.
  pick(x, y) {
    const box = this.renderer.domElement.getBoundingClientRect(), ray = new THREE.Raycaster();
    const at = new THREE.Vector2((2 * (x - box.left)) / box.width - 1, 1 - (2 * (y - box.top)) / box.height);
    ray.setFromCamera(at, this.camera);
    const all = this.surfaces.filter((s) => !(s.clear && this.through.checked));
    const meshes = [...(all.length ? all : this.surfaces), ...(this.section ? [this.section] : [])];
    const hit = ray.intersectObjects(meshes.map((m) => m.mesh), false).find((h) =>
      !this.plane || (this.section && h.object === this.section.mesh) || this.plane.distanceToPoint(h.point) >= 0);
    this.picked = hit ? this.pickedOf(hit, meshes.find((m) => m.mesh === hit.object)) : null;
    this.tell();
    return this.picked;
  }

  /// The point by its weights in the triangle, of which the corners are doubles: in the scene they are floats.
  pickedOf(hit, from) {
    const { cell, corners } = from.owners ? from.owners[hit.faceIndex] : {
      cell: from.cells[hit.faceIndex],
      corners: [0, 1, 2].map((i) => Array.from(from.at(from.triangles[3 * hit.faceIndex + i]))),
    };
    const w = THREE.Triangle.getBarycoord(hit.point, ...corners.map((p) => new THREE.Vector3(...this.placed(p))), new THREE.Vector3()).toArray();
    return { cell, point: [0, 1, 2].map((k) => w[0] * corners[0][k] + w[1] * corners[1][k] + w[2] * corners[2][k]) };
  }

  tell() {
    this.mark.visible = Boolean(this.picked);
    this.said.textContent = this.picked ? "" : "There is nothing.";
    if (this.picked) {
      const { cell, point } = this.picked, n = this.corners;
      const nodes = Array.from(this.cells.subarray(n * cell, n * cell + n));
      this.mark.geometry.dispose();
      this.mark.geometry = new THREE.BufferGeometry().setFromPoints(nodes.flatMap((a, i) => nodes.slice(i + 1).flatMap((b) =>
        [a, b].map((v) => new THREE.Vector3(...this.placed(this.node(v)))))));
      const answer = this.answerAt(cell, point);
      const number = this.data.arrays[this.data.numbers], name = this.data.arrays[this.data.nodes];
      const say = (...parts) => this.said.append(Object.assign(document.createElement("p"), { textContent: parts.join("") }));
      say("cell ", number[cell], " at (", point.slice(0, this.data.dimension).join(", "), ")");
      if (!answer) say("it has no weights: the cell is degenerate");
      else say("weights ", nodes.map((v, i) => `${answer.weights[i]} of node ${name[v]}`).join(", "));
      if (this.choice && answer) say(this.choice.name, " = ", answer.value, this.choice.unit ? ` ${this.choice.unit}` : "");
    }
    this.draw();
  }

  /// The weights of the point in the cell and the value of the field there, exact and rounded once.
  answerAt(cell, point) {
    const nodes = Array.from(this.cells.subarray(this.corners * cell, this.corners * (cell + 1)));
    const exact = exactWeights(nodes.map((v) => Array.from(this.node(v))), point);
    if (!exact) return null;
    const { numerators, denominator } = exact, of = this.choice;
    const values = !of ? [] : of.ofCells ? [of.at(cell)] : nodes.map((v) => of.at(v));
    let value = of && of.ofCells ? values[0] : NaN;
    // A node without a weight takes no part.
    if (of && !of.ofCells && values.every((x, i) => numerators[i] === 0n || Number.isFinite(x))) {
      const { all, exponent } = integers(values.map((x) => (Number.isFinite(x) ? x : 0)));
      value = nearest(numerators.reduce((sum, n, i) => sum + n * all[i], 0n), denominator, exponent);
    }
    return { weights: numerators.map((n) => nearest(n, denominator)), value };
  }

  /// Where a point of the mesh is drawn, in parts of the canvas from its upper left corner; and in pixels of the window.
  partsOf(point) {
    const at = new THREE.Vector3(...this.placed(point)).project(this.camera);
    return [(at.x + 1) / 2, (1 - at.y) / 2];
  }
  pixelOf(point) {
    const [x, y] = this.partsOf(point), box = this.renderer.domElement.getBoundingClientRect();
    return [box.left + x * box.width, box.top + y * box.height];
  }
}

document.head.append(Object.assign(document.createElement("style"), { textContent: `
.turning .tools{display:flex;flex-wrap:wrap;gap:6px 14px;align-items:center;margin:4px 0}
.turning .tools *{font:inherit;max-width:100%}.turning .tools button{border:1px solid;border-radius:4px;padding:1px 10px;cursor:pointer}
.turning .stage{position:relative;overflow:hidden}.turning .stage span{position:absolute;pointer-events:none;font-weight:bold;
 transform:translate(-50%,-50%);padding:0 5px;border-radius:9px;background:#0072b2;color:#fff;font-size:12px}
.turning .stage .bad{background:#c8102e}
.turning canvas{display:block;width:100%;height:auto;touch-action:none;outline:none}
.turning .bar div{height:14px;border-radius:2px}.turning .bar p{display:flex;justify-content:space-between;margin:2px 0}
.turning .bar{max-width:420px;margin:6px 0}.turning .said{display:block;min-height:76px;overflow-wrap:anywhere}
.turning .said p{margin:2px 0}
` }));
window.viewMesh = (figure, buffer) => {
  // Without WebGL the still picture stays.
  if (document.createElement("canvas").getContext("webgl2")) figure.viewer = new Viewer(figure, buffer);
};
