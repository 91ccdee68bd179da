// The picture of a page for the documents: its first screen, light.
//
//   node picture.js PAGE PICTURE CHROMIUM
"use strict";
const path = require("path");
const { pathToFileURL } = require("url");
const playwright = require("playwright-core");

const [page, picture, chromium] = process.argv.slice(2);
(async () => {
  const browser = await playwright.chromium.launch({ executablePath: chromium, args: ["--no-sandbox"] });
  const shown = await browser.newPage({ viewport: { width: 1080, height: 720 }, colorScheme: "light" });
  await shown.goto(pathToFileURL(path.resolve(page)).href);
  await shown.screenshot({ path: picture });
  await browser.close();
})();
