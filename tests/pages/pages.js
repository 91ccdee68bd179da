// The HTML pages of audit, check, verify and render in Chromium.
//
//   node pages.js PROGRAM DATA FOLDER CHROMIUM
//
// PROGRAM  barycert; DATA its folder of meshes; FOLDER is replaced, pages and pictures of them go there
// Exit code 77: playwright-core is missing (NODE_PATH names the folder it is in); 1 if BARYCERT_PAGES_REQUIRED is set.
"use strict";
const { execFileSync } = require("child_process");
const fs = require("fs");
const path = require("path");
const { pathToFileURL } = require("url");

const [program, data, folder, chromium] = process.argv.slice(2);
let playwright;
try {
  playwright = require("playwright-core");
} catch (error) {
  console.log("playwright-core is missing; `./run pages` installs it");
  process.exit(process.env.BARYCERT_PAGES_REQUIRED ? 1 : 77);
}

let failures = 0;
function check(ok, what) {
  if (!ok) {
    ++failures;
    console.log("FAILS: " + what);
  }
}

/// Runs the program; the page that --html names, or `option`.
function made(name, args, { code = 0, input = "", option = "--html" } = {}) {
  let ended = 0;
  try {
    execFileSync(program, [...args, "--quiet", option, name], { cwd: folder, input, stdio: ["pipe", "pipe", "inherit"] });
  } catch (error) {
    ended = error.status;
  }
  if (ended !== code) throw new Error(`exit code ${ended}, not ${code}: barycert ${args.join(" ")}`);
  return name;
}

function makePages() {
  const mesh = (name) => path.join(data, "meshes", name);
  const others = (name) => path.join(data, "measured", name + ".json");
  // A mesh with a name that would be a tag, and one of its nodes moved.
  const nasty = "a<img src=x onerror=alert(1)>&\"b";
  fs.copyFileSync(mesh("cube-hole.ele"), path.join(folder, nasty + ".ele"));
  const nodes = fs.readFileSync(mesh("cube-hole.node"), "utf8").replace(/^408 0\.4/m, "408 0.5");
  fs.writeFileSync(path.join(folder, nasty + ".node"), nodes);
  // Results with all kinds of errors.
  let rows = "x,y,z,attribute0\n";
  for (let i = 0; i < 200; ++i) {
    const [x, y, z] = [i / 200, ((i * 7) % 200) / 200, ((i * 31) % 200) / 200];
    rows += `${x},${y},${z},${i % 3 === 0 ? "nan" : i}\n`;
  }
  fs.writeFileSync(path.join(folder, nasty + ".csv"), rows);
  return {
    audit: made("audit.html", ["audit", "--count", "300", "--json", "audit.json", "--with", others("flags"), "--with", others("systems")]),
    nasty: made("nasty.html", ["audit", nasty, "--count", "50", "--family", "mesh.*", "--kernel", "*.kahan", "--kernel", "*.exact"]),
    one: made("one.html", ["audit", "--count", "200", "--kernel", "tetrahedron.cramer"]),
    right: made("right.html", ["audit", "--count", "50", "--kernel", "tetrahedron.exact"]),
    check: made("check.html", ["check", mesh("flange")]),
    broken: made("broken.html", ["check", nasty], { code: 1 }),
    plane: made("plane.html", ["check", mesh("plate")]),
    scene: made("scene.html", ["render", "mesh", mesh("cube-hole"), "--field", "attribute0", "--edges", "--view", "+x"],
      { option: "--output" }),
    flat: made("flat.html", ["render", "mesh", mesh("plate"), "--field", "attribute0", "--outline"], { option: "--output" }),
    part: made("part.html", ["render", "mesh", mesh("bracket"), "--threshold", "attribute0=2,8", "--field", "grad(attribute1).0",
      "--unit", "K/m"], { option: "--output" }),
    verify: made("verify.html", ["verify", mesh("cube-hole"), "--results", nasty + ".csv"], { code: 1 }),
  };
}

/// Texts whose contrast with their ground is below 4.5 (WCAG AA), as far as grounds are plain colours.
function poorContrast() {
  const canvas = document.createElement("canvas").getContext("2d", { willReadFrequently: true });
  function parsed(colour) {
    canvas.clearRect(0, 0, 1, 1);
    canvas.fillStyle = colour;
    canvas.fillRect(0, 0, 1, 1);
    return Array.from(canvas.getImageData(0, 0, 1, 1).data);
  }
  function light([r, g, b]) {
    const linear = [r, g, b].map((c) => (c / 255 <= 0.04045 ? c / 255 / 12.92 : ((c / 255 + 0.055) / 1.055) ** 2.4));
    return 0.2126 * linear[0] + 0.7152 * linear[1] + 0.0722 * linear[2];
  }
  function ground(element) {
    for (let e = element; e; e = e.parentElement) {
      const colour = parsed(getComputedStyle(e).backgroundColor);
      if (colour[3] === 255) return colour;
    }
    return [255, 255, 255, 255];
  }
  const poor = new Map();
  const walker = document.createTreeWalker(document.body, NodeFilter.SHOW_TEXT);
  for (let node = walker.nextNode(); node; node = walker.nextNode()) {
    const element = node.parentElement;
    if (!node.textContent.trim() || ["SCRIPT", "STYLE", "title"].includes(element.tagName)) continue;
    if (element.matches("svg .halo")) continue; // lies under the text itself
    const style = getComputedStyle(element);
    const colour = parsed(element.closest("svg") ? style.fill : style.color);
    const [a, b] = [light(colour), light(ground(element))];
    const contrast = (Math.max(a, b) + 0.05) / (Math.min(a, b) + 0.05);
    if (contrast < 4.5) poor.set(`${element.tagName}.${element.getAttribute("class")}`, contrast.toFixed(2));
  }
  return Array.from(poor, ([what, contrast]) => `${what} ${contrast}`);
}

/// Checks what any reader of the page's structure asks for.
function structure() {
  const wrong = [];
  if (document.documentElement.lang !== "en") wrong.push("no language");
  if (!document.title) wrong.push("no title");
  if (document.querySelectorAll("h1").length !== 1) wrong.push("not one h1");
  if (document.querySelectorAll("main").length !== 1) wrong.push("not one main");
  let level = 1;
  for (const h of document.querySelectorAll("h1,h2,h3")) {
    const now = Number(h.tagName[1]);
    if (now > level + 1) wrong.push("a level of headings is left out before " + h.textContent);
    level = now;
  }
  for (const img of document.images) {
    if (!img.alt) wrong.push("img without alt");
    if (!img.complete || img.naturalWidth === 0) wrong.push("img that does not show");
  }
  for (const svg of document.querySelectorAll("svg")) {
    if (svg.getAttribute("role") !== "img" || !svg.querySelector("title")) wrong.push("svg without title");
  }
  for (const table of document.querySelectorAll("table:not(.bars)")) {
    if (!table.querySelector("th")) wrong.push("table without heads");
  }
  for (const alien of document.querySelectorAll("[onerror],[onclick],link,iframe,object,embed,a[href]")) wrong.push(alien.outerHTML);
  return wrong;
}

/// Elements that stick out of the page, other than what scrolls by itself.
function stickingOut() {
  const width = document.documentElement.clientWidth;
  const out = [];
  for (const e of document.body.querySelectorAll("*")) {
    const box = e.getBoundingClientRect();
    if (box.width === 0 || box.right <= width + 1 || e.closest(".scroll") || e.closest("svg,details:not([open])")) continue;
    out.push(`${e.tagName}.${e.className} to ${Math.round(box.right)} of ${width}`);
  }
  return out;
}

/// A4 without the margins of the style's @page, in CSS pixels.
const paperWidth = Math.floor(((210 - 2 * 12) / 25.4) * 96);

/// How many parts of each kind can be seen.
function shownParts() {
  const count = {};
  for (const e of document.body.querySelectorAll("h1,h2,h3,th,td,img,svg,figcaption,dt,dd,p,code")) {
    const box = e.getBoundingClientRect();
    const shown = getComputedStyle(e).visibility === "visible" && box.width > 0 && box.height > 0;
    count[e.tagName] = (count[e.tagName] || 0) + (shown ? 1 : 0);
  }
  return count;
}

/// Elements that end beyond the paper, or hide a part of what is in them: paper does not scroll.
function cutOff() {
  const out = [];
  for (const e of document.body.querySelectorAll("*")) {
    if (e.closest("svg") && e.tagName !== "svg") continue;
    const box = e.getBoundingClientRect();
    if (box.width === 0) continue;
    const hides = getComputedStyle(e).overflowX !== "visible" && e.scrollWidth > e.clientWidth + 1;
    if (hides || box.left < -1 || box.right > document.documentElement.clientWidth + 1)
      out.push(`${e.tagName}.${e.className} from ${Math.round(box.left)} to ${Math.round(box.right)}`);
  }
  return out;
}

/// The numbers of a file of TetGen, but for its first line: a row each.
function rowsOf(file) {
  const lines = fs.readFileSync(file, "utf8").split("\n").map((line) => line.replace(/#.*/, "").trim()).filter(Boolean);
  return lines.slice(1).map((line) => line.split(/\s+/).map(Number));
}

/// A mesh that turns: what it says where it is clicked, on screens of both kinds, by mouse and by finger.
async function turning(opened, mesh) {
  const nodes = rowsOf(mesh + ".node"), cells = rowsOf(mesh + ".ele");
  // Cells with a facet on the side that the camera sees, by the files alone.
  const seen = cells.map((row) => row.slice(1, 5)).flatMap((corners, cell) => {
    const facet = corners.filter((v) => nodes[v][1] === 1);
    return facet.length === 3 ? [{ cell, middle: [1, 2, 3].map((k) => facet.reduce((sum, v) => sum + nodes[v][k] / 3, 0)) }] : [];
  });
  check(seen.length > 20, `${seen.length} cells are seen`);
  const some = Array.from({ length: 300 }, (_, i) => [i * 0.618034, i * 0.7548777, i * 0.5698403].map((x) => x % 1).join(","));
  const table = execFileSync(program, ["sample", mesh, "--points", "-", "--fields", "attribute0", "--output", "-"],
    { input: ["x,y,z", ...some, ""].join("\n"), encoding: "utf8", stdio: ["pipe", "pipe", "ignore"] });
  const [heads, ...rows] = table.trim().split("\n").map((line) => line.split(","));
  const column = (row, name) => Number(row[heads.indexOf(name)]);
  for (const options of [{ viewport: { width: 1280, height: 900 } }, { viewport: { width: 390, height: 844 }, hasTouch: true }]) {
    await opened("scene", options, async (page, where) => {
      const said = () => page.locator(".said").textContent();
      for (const { cell, middle } of seen) {
        const [x, y] = await page.evaluate((p) => document.querySelector(".turning").viewer.pixelOf(p), middle);
        await (options.hasTouch ? page.touchscreen.tap(x, y) : page.mouse.click(x, y));
        const words = await said();
        check(words.startsWith(`cell ${cell} at (1, `), `${where}: cell ${cell} at ${x}, ${y} is said to be ${words}`);
      }
      await page.mouse.click((await page.locator(".turning canvas").boundingBox()).x + 2, 300);
      check((await said()) === "There is nothing.", `${where}: beside the mesh: ${await said()}`);
      // Values are those of the program, to the bit.
      for (const row of rows) {
        const cell = column(row, "cell"), point = ["x", "y", "z"].map((name) => column(row, name));
        if (cell < 0) continue;
        const { value, weights } = await page.evaluate(([c, p]) => document.querySelector(".turning").viewer.answerAt(c, p), [cell, point]);
        check(value === column(row, "attribute0"), `${where}: at ${point} ${value}, not ${row}`);
        check(weights.every((w) => w >= 0) && Math.abs(weights.reduce((a, b) => a + b, 0) - 1) < 1e-15, `${where}: weights ${weights}`);
      }
      // Turned and reset it is as before; cut, a section is seen; without colours another picture.
      const picture = () => page.locator(".turning canvas").screenshot();
      const first = await picture(), box = await page.locator(".turning canvas").boundingBox();
      await page.mouse.move(box.x + 100, box.y + 100);
      await page.mouse.down();
      await page.mouse.move(box.x + 180, box.y + 140, { steps: 4 });
      await page.mouse.up();
      check(!first.equals(await picture()), `${where}: does not turn`);
      await page.getByRole("button", { name: "Reset" }).click();
      check(first.equals(await picture()), `${where}: reset does not bring it back`);
      for (const key of ["ArrowRight", "Shift+ArrowLeft"]) {
        await page.locator(".turning canvas").focus();
        for (let k = 0; k < 5; ++k) await page.keyboard.press(key);
        await page.locator(".turning canvas").evaluate((canvas) => canvas.blur());
        check(!first.equals(await picture()), `${where}: ${key} does nothing`);
        await page.getByRole("button", { name: "Reset" }).click();
        check(first.equals(await picture()), `${where}: after ${key} reset does not bring it back`);
      }
      await page.getByRole("combobox", { name: /^Cut/ }).selectOption("x");
      check(!first.equals(await picture()), `${where}: is not cut`);
      await page.mouse.click(box.x + box.width / 2, box.y + box.height * 0.2);
      check(/^cell \d+ at \(0\.5/.test(await said()), `${where}: in the section: ${await said()}`);
      await page.getByRole("combobox", { name: /^Cut/ }).selectOption("none");
      const coloured = await picture();
      await page.getByRole("combobox", { name: /^Field/ }).selectOption({ index: 0 });
      check(!coloured.equals(await picture()), `${where}: keeps its colours`);
    });
  }
}

/// A mesh in the plane moves where it is dragged. In a part of a mesh cells and nodes have the numbers of the whole,
/// from 0.
async function turningOthers(opened, bracket) {
  await opened("flat", { viewport: { width: 900, height: 900 } }, async (page, where) => {
    const middle = () => page.evaluate(() => document.querySelector(".turning").viewer.pixelOf([1, 1, 0]));
    const [before, box] = [await middle(), await page.locator(".turning canvas").boundingBox()];
    await page.mouse.move(box.x + 300, box.y + 200);
    await page.mouse.down();
    await page.mouse.move(box.x + 350, box.y + 230, { steps: 5 });
    await page.mouse.up();
    const after = await middle();
    check(Math.abs(after[0] - before[0] - 50) < 1 && Math.abs(after[1] - before[1] - 30) < 1, `${where}: ${before} to ${after}`);
  });
  await opened("part", { viewport: { width: 900, height: 900 } }, async (page, where) => {
    const rows = rowsOf(bracket + ".ele"), nodes = rowsOf(bracket + ".node");
    const { cells, names, numbers, points } = await page.evaluate(() => {
      const { data } = document.querySelector(".turning").viewer, list = (name) => Array.from(data.arrays[data[name]]);
      return { cells: list("cells"), names: list("nodes"), numbers: list("numbers"), points: list("points") };
    });
    check(numbers.length > 100 && numbers.length < rows.length, `${where}: ${numbers.length} cells`);
    numbers.forEach((number, cell) => {
      const file = rows[number].slice(1, 5).map((v) => v - 1), own = cells.slice(4 * cell, 4 * cell + 4);
      check(own.every((v, i) => names[v] === file[i]), `${where}: cell ${number} has nodes ${own.map((v) => names[v])}, not ${file}`);
      check(own.every((v) => [0, 1, 2].every((k) => points[3 * v + k] === nodes[names[v]][k + 1])), `${where}: places of ${number}`);
    });
    check((await page.locator(".bar").textContent()).startsWith("grad(attribute1).0 (K/m)"), `${where}: ${await page.locator(".bar").textContent()}`);
  });
}

async function main() {
  fs.rmSync(folder, { recursive: true, force: true });
  fs.mkdirSync(folder, { recursive: true });
  const pages = makePages();
  const browser = await playwright.chromium.launch({
    executablePath: chromium, args: ["--no-sandbox", "--use-angle=swiftshader", "--enable-unsafe-swiftshader"] });

  async function opened(name, options, look) {
    const context = await browser.newContext(options);
    await context.grantPermissions(["clipboard-read", "clipboard-write"]).catch(() => {});
    const page = await context.newPage();
    const where = `${name} ${JSON.stringify(options)}`;
    const url = pathToFileURL(path.join(folder, pages[name])).href;
    page.on("console", (message) => check(false, `${where}: console: ${message.text()}`));
    page.on("pageerror", (error) => check(false, `${where}: ${error}`));
    page.on("dialog", (dialog) => { check(false, `${where}: dialog ${dialog.message()}`); dialog.dismiss(); });
    page.on("request", (request) => {
      if (request.url() !== url && !request.url().startsWith("data:")) check(false, `${where}: asks for ${request.url()}`);
    });
    await page.goto(url, { waitUntil: "load" });
    if (options.javaScriptEnabled !== false)
      await page.waitForFunction(() => !document.querySelector(".turning") || document.querySelector(".turning").viewer);
    await look(page, where);
    await context.close();
  }

  for (const name of Object.keys(pages)) {
    for (const colorScheme of ["light", "dark"]) {
      for (const width of [1400, 390]) {
        await opened(name, { viewport: { width, height: 900 }, colorScheme }, async (page, where) => {
          const scroll = await page.evaluate(() => [document.documentElement.scrollWidth, innerWidth]);
          check(scroll[0] <= scroll[1], `${where}: ${scroll[0]} pixels wide`);
          for (const what of await page.evaluate(stickingOut)) check(false, `${where}: sticks out: ${what}`);
          for (const what of await page.evaluate(structure)) check(false, `${where}: ${what}`);
          for (const what of await page.evaluate(poorContrast)) check(false, `${where}: contrast: ${what}`);
          const ground = await page.evaluate(() => getComputedStyle(document.body).backgroundColor);
          check((ground === "rgb(255, 255, 255)") === (colorScheme === "light"), `${where}: ground ${ground}`);
          const picture = path.join(folder, `${name}-${width}-${colorScheme}.png`);
          await page.screenshot({ path: picture, fullPage: false });
          if (process.env.FULL_PAGES) await page.screenshot({ path: picture.replace(".png", "-full.png"), fullPage: true });
        });
      }
    }
    // Everything that is shown is there without JavaScript, too.
    const words = {};
    for (const javaScriptEnabled of [true, false]) {
      await opened(name, { javaScriptEnabled }, async (page) => {
        // But for the mesh that turns, which stands still there.
        const said = await page.locator("main").evaluate((main) => {
          const all = main.cloneNode(true);
          for (const figure of all.querySelectorAll(".turning, script, style")) figure.remove();
          return all.textContent;
        });
        words[javaScriptEnabled] = said.replace(/Copy/g, "").replace(/\s+/g, " ");
      });
    }
    check(words[true] === words[false], `${name}: without JavaScript the words are others`);
  }

  const report = JSON.parse(fs.readFileSync(path.join(folder, "audit.json"), "utf8"));
  await opened("audit", { viewport: { width: 1400, height: 900 } }, async (page) => {
    // The league table is the JSON's.
    const rows = () => page.$$eval("table.kernels tbody tr", (all) => all.map((tr) => ({
      name: tr.cells[0].textContent, numbers: Array.from(tr.cells).slice(1).map((c) => Number(c.dataset.v)) })));
    const first = await rows();
    const exactly = (kernel, region) => Object.values(kernel.confusion[region]).reduce((a, b) => a + b, 0);
    const none = (x) => (x === null ? -1 : x === Number.MAX_VALUE ? Infinity : x);
    const share = (part, whole) => (whole === 0 ? -1 : part / whole);
    check(first.length === report.kernels.length, "a row for each kernel");
    report.kernels.forEach((k, i) => {
      const wanted = [k.cases, share(k.wrong_cases, k.cases),
        share(k.false_outside, exactly(k, "interior") + exactly(k, "boundary")),
        share(k.false_inside, exactly(k, "outside")), share(k.by_error[22], k.cases - exactly(k, "degenerate")),
        undefined, none(k.worst_error),
        Math.max(-1, ...k.families.filter((f) => f.name.startsWith("mesh.")).map((f) => none(f.worst_error))),
        none(k.worst_weight_ulp), k.ns];
      check(first[i].name === k.name, `row ${i} is ${first[i].name}, not ${k.name}`);
      wanted.forEach((x, c) => check(x === undefined || first[i].numbers[c] === x,
        `${k.name}, column ${c}: ${first[i].numbers[c]}, in the JSON ${x}`));
    });
    // Every head sorts, down and up; the rows stay the same ones.
    const heads = page.locator("table.kernels thead th button");
    for (let c = 0; c < (await heads.count()); ++c) {
      const keys = async () => (await rows()).map((r) => (c === 0 ? r.name : r.numbers[c - 1]));
      const order = (a, b) => (c === 0 ? a.localeCompare(b) : a - b || 0);
      const sorted = (all, sign) => all.every((x, i) => i === 0 || sign * order(all[i - 1], x) <= 0 || all[i - 1] === x);
      await heads.nth(c).click();
      check(sorted(await keys(), c === 0 ? 1 : -1), `column ${c} does not sort`);
      await heads.nth(c).click();
      check(sorted(await keys(), c === 0 ? -1 : 1), `column ${c} does not sort the other way`);
      check((await rows()).length === first.length, "rows are lost");
      check((await page.locator("table.kernels th[aria-sort]").count()) === 1, "one column is the sorted one");
    }
    // By keyboard, too.
    await heads.nth(0).focus();
    await page.keyboard.press("Enter");
    check((await page.locator("table.kernels th[aria-sort=ascending]").count()) === 1, "no sorting by keyboard");
    // The commands are copied as they stand there.
    const codes = page.locator("code.copy");
    check((await codes.count()) === (await page.locator("button.copy").count()), "a button for each command");
    for (const i of [0, (await codes.count()) - 1]) {
      const code = codes.nth(i);
      await code.locator("xpath=following-sibling::button[1]").click();
      const copied = await page.evaluate(() => navigator.clipboard.readText());
      check(copied === (await code.textContent()), `copied: ${copied}`);
    }
    // A copied command of a witness does what it says: it exits with 0.
    const command = (await codes.first().textContent()).split(" ").slice(1);
    execFileSync(program, command, { cwd: folder, stdio: ["ignore", "ignore", "inherit"] });
    // So do the tables of flags and systems.
    const tables = page.locator("h2:has-text('under compiler flags') ~ .scroll table, h2:has-text('Systems:') ~ .scroll table");
    check((await tables.count()) === 4, `${await tables.count()} tables of flags and systems`);
    for (let t = 0; t < (await tables.count()); ++t) {
      const table = tables.nth(t);
      const column = () => table.locator("tbody tr td.n:nth-of-type(3)").evaluateAll((all) => all.map((td) => Number(td.dataset.v)));
      const before = await column();
      await table.locator("thead th:nth-child(4) button").click();
      const after = await column();
      check(before.length > 5 && after.length === before.length, `table ${t}: ${after.length} rows`);
      check(after.every((x, i) => i === 0 || after[i - 1] >= x), `table ${t} does not sort: ${after}`);
    }
    // Maps: pictures that differ from kernel to kernel.
    const maps = await page.$$eval(".maps", (meshes) => meshes.map((m) => Array.from(m.querySelectorAll("img"), (i) => i.src)));
    check(maps.length === 4, `${maps.length} maps`);
    for (const kernels of maps) check(kernels.length === 6 && new Set(kernels).size > 2, "maps are the same");
    // Pictures of signs: the exact one first in each kind, and all of them differ.
    const pictures = await page.$$eval(".signs", (kinds) => kinds.map((kind) => Array.from(kind.querySelectorAll("img"), (i) => i.src)));
    check(pictures.length === 4, `${pictures.length} kinds of pictures of signs`);
    for (const kind of pictures) check(new Set(kind).size === kind.length, "the same picture twice");
    check((await page.locator(".signs figure:first-child.exact").count()) === pictures.length, "no exact picture first");
  });
  await turning(opened, path.join(data, "meshes", "cube-hole"));
  await turningOthers(opened, path.join(data, "meshes", "bracket"));
  // On paper nothing is left out that the screen has, nothing is cut off, and the ground is white.
  for (const name of Object.keys(pages)) {
    await opened(name, { viewport: { width: paperWidth, height: 1000 }, colorScheme: "dark" }, async (page, where) => {
      const onScreen = await page.evaluate(shownParts);
      await page.emulateMedia({ media: "print", colorScheme: "dark" });
      const ground = await page.evaluate(() => getComputedStyle(document.body).backgroundColor);
      check(ground === "rgb(255, 255, 255)", `${where}: dark paper`);
      await page.evaluate(() => dispatchEvent(new Event("beforeprint")));
      for (const [what, count] of Object.entries(await page.evaluate(shownParts)))
        check(count >= onScreen[what], `${where}: on paper ${count} ${what}, on the screen ${onScreen[what]}`);
      for (const what of await page.evaluate(cutOff)) check(false, `${where}: cut off on paper: ${what}`);
      check((await page.locator("details:not([open])").count()) === 0, `${where}: folded on paper`);
      await page.screenshot({ path: path.join(folder, `${name}-print.png`), fullPage: Boolean(process.env.FULL_PAGES) });
      await page.evaluate(() => dispatchEvent(new Event("afterprint")));
      // Printing itself opens what is folded, and folds it again.
      const folds = await page.locator("details").count();
      await page.evaluate(() => {
        window.whenPrinted = null;
        addEventListener("beforeprint", () => { window.whenPrinted = document.querySelectorAll("details[open]").length; });
      });
      await page.pdf({ path: path.join(folder, `${name}.pdf`), format: "A4" });
      check((await page.evaluate(() => window.whenPrinted)) === folds, `${where}: what is folded is printed so`);
      check((await page.locator("details[open]").count()) === 0, `${where}: stays unfolded after printing`);
    });
  }
  await browser.close();
  console.log(failures === 0 ? `${Object.keys(pages).length} pages: all well` : `${failures} failures`);
  process.exit(failures === 0 ? 0 : 1);
}

main().catch((error) => {
  console.log("FAILS: " + (error.stack || error));
  process.exit(1);
});
