// A page in a real browser, and what tests of it share.
import { execFileSync, spawn } from "node:child_process";
import { once } from "node:events";
import { existsSync, mkdtempSync, readFileSync, rmSync, writeFileSync } from "node:fs";
import { tmpdir } from "node:os";
import { join, resolve } from "node:path";
import puppeteer from "puppeteer-core";
import { root } from "./files.mjs";

export const program = process.env.LINKWORK;
export const folder = mkdtempSync(join(tmpdir(), "linkwork-page-"));
export const browser = await puppeteer.launch({
  executablePath: process.env.CHROMIUM ?? "/usr/bin/chromium",
  args: ["--no-sandbox", "--use-angle=swiftshader", "--enable-unsafe-swiftshader", "--ignore-gpu-blocklist"],
});
let wrong = 0;

export function check(holds, words) {
  if (holds) return;
  wrong++;
  console.log(`wrong: ${words}`);
}

/** The page of a file, made by the program; every complaint of the browser and every request is counted. */
export async function opened(file, fragment = "") {
  const path = join(folder, `${file.replaceAll(/[/.]/g, "_")}.html`);
  if (process.env.PAGE) {
    // a page that was built anew, filled in as the program does
    const text = file && readFileSync(resolve(root, file), "utf8");
    const data = JSON.stringify({ file, text, set: [], watch: false }).replaceAll("<", "\\u003c");
    writeFileSync(path, readFileSync(process.env.PAGE, "utf8").replace("{mechanism}", () => data));
  } else {
    const given = ["view", file, "-o", path].filter(Boolean);
    execFileSync(program, given, { cwd: root, stdio: ["ignore", "ignore", "inherit"] });
  }
  return shown(path, fragment);
}

export async function shown(path, fragment = "") {
  const page = await browser.newPage();
  await page.setViewport({ width: 800, height: 500 });
  page.complaints = [];
  page.on("console", (message) => ["error", "warn"].includes(message.type()) && page.complaints.push(message.text()));
  page.on("pageerror", (error) => page.complaints.push(error.message));
  page.on("request", (request) => {
    const own = request.url().startsWith("file:") || request.url().startsWith("blob:");
    if (!own) page.complaints.push(`asks for ${request.url()}`);
  });
  await page.goto(`file://${path}${fragment}`);
  await page.waitForSelector("html[data-ready]");
  return page;
}

let shared = null;

/** A file in the page that is open already, shown as the gallery shows it: as fast as that, for what no fresh page is needed. */
export async function loaded(file) {
  shared ??= await opened("mechanisms/four_bar.ron");
  await shared.bringToFront();
  shared.complaints.length = 0;
  const text = readFileSync(resolve(root, file), "utf8");
  await shared.evaluate((file, text) => {
    document.querySelectorAll("#panel details").forEach((part) => (part.open = true));
    globalThis.linkwork.load({ file, text, set: [] });
  }, file, text);
  await drawn(shared);
  return shared;
}

export const drawn = (page) => page.evaluate(() => new Promise((done) => requestAnimationFrame(() => requestAnimationFrame(done))));

/** How many pixels of the picture are not paper. */
export const inked = (page) => page.evaluate(() => {
  const canvas = document.getElementById("canvas");
  const copy = new OffscreenCanvas(canvas.width, canvas.height).getContext("2d");
  copy.drawImage(canvas, 0, 0);
  const { data } = copy.getImageData(0, 0, canvas.width, canvas.height);
  let count = 0;
  for (let i = 0; i < data.length; i += 4) {
    if (Math.abs(data[i] - data[0]) + Math.abs(data[i + 1] - data[1]) + Math.abs(data[i + 2] - data[2]) > 30) count++;
  }
  return count;
});

/** Takes hold of a place of the picture and moves it so many pixels. */
export async function dragged(page, [x, y], [right, down]) {
  const box = await page.$eval("#canvas", (canvas) => canvas.getBoundingClientRect().toJSON());
  await page.mouse.move(box.x + x, box.y + y);
  await page.mouse.down();
  for (let i = 1; i <= 12; i++) {
    await page.mouse.move(box.x + x + (right * i) / 12, box.y + y + (down * i) / 12);
    await page.evaluate(() => new Promise((done) => requestAnimationFrame(done)));
  }
  await page.mouse.up();
}

export const values = (page) => page.evaluate(() => globalThis.linkwork.frame.values.map(([value]) => value));
export const said = (page) => page.$eval("#said", (element) => element.textContent);


/** Runs the tests, or those whose names have one of the words of the command line in them. */
export async function run(tests) {
  const wanted = process.argv.slice(2);
  try {
    for (const [name, test] of Object.entries(tests)) {
      if (wanted.length && !wanted.some((part) => name.includes(part))) continue;
      const [before, begun] = [wrong, Date.now()];
      try {
        await test();
      } catch (error) {
        wrong++;
        console.log(`wrong: ${error.stack}`);
      }
      console.log(`${wrong === before ? "ok" : "FAILED"}  ${name} (${Date.now() - begun} ms)`);
    }
  } finally {
    await browser.close();
    rmSync(folder, { recursive: true, force: true });
  }
  process.exit(wrong ? 1 : 0);
}
