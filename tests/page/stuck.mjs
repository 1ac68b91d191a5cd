// The page never gets stuck: singular configurations are left again, limits are named, everything can be undone, and
// what is held is chosen in any order.
import { check, dragged, drawn, loaded, run, said, values } from "./harness.mjs";

const held = (page) => page.evaluate(() => globalThis.linkwork.frame.held.toSorted().join(" "));

const rest = (ms) => new Promise((done) => setTimeout(done, ms));

/** Where a point of the plate of the 3-RPS is in the picture. */
const corner = (page) => page.evaluate(() => {
  const plate = globalThis.linkwork.frame.scene.bodies.find((body) => body.platform);
  return globalThis.picture.pixel(plate.corners[0].map((x, i) => 0.9 * x + 0.05 * plate.corners[1][i] + 0.05 * plate.corners[2][i]));
});

/** Writes into a field and presses Enter. */
async function written(page, selector, text) {
  await page.evaluate((selector) => {
    const field = document.querySelector(selector);
    field.focus();
    field.select();
  }, selector);
  await page.keyboard.type(text);
  await page.keyboard.press("Enter");
  await drawn(page);
}

const tests = {
  async "a plate that is dragged into a singular configuration is dragged out of it, and sliders leave it too"() {
    const page = await loaded("mechanisms/three_rps.ron");
    for (const [right, down] of [[0, 75], [0, 75], [0, 60], [30, -80], [0, -120]]) {
      const before = await values(page);
      await dragged(page, await corner(page), [right, down]);
      const after = await values(page);
      check(after.some((value, i) => Math.abs(value - before[i]) > 1e-3), `a drag by ${right}, ${down} moved nothing: ${await said(page)}`);
      check(!/start is singular|linkwork/.test(await said(page)), `the page says: ${await said(page)}`);
    }
    await dragged(page, await corner(page), [0, 75]);
    for (const name of ["l1", "l2", "l3"]) {
      const moved = await page.evaluate((name) => {
        const { linkwork } = globalThis;
        const at = () => linkwork.frame.values[linkwork.mechanism.coordinates.findIndex((of) => of.name === name)][0];
        const before = at();
        linkwork.move(name, 0.9 * before + 0.1 * 0.9);
        return Math.abs(at() - before);
      }, name);
      check(moved > 1e-4, `the slider of ${name} is stuck: ${await said(page)}`);
    }
  },

  async "a crank is dragged through the dead points of a rocker that is held"() {
    const page = await loaded("mechanisms/four_bar.ron");
    await page.evaluate(() => globalThis.holding.hold("phi1"));
    const turned = await page.evaluate(() => {
      const { linkwork } = globalThis;
      const crank = linkwork.frame.scene.bodies.findIndex((body) => body.name === "left.1");
      const [, tip] = linkwork.frame.scene.bodies[crank].lines[0];
      const { grip } = linkwork.ask({ do: "grab", body: crank, at: tip });
      const begin = linkwork.frame.values[0][0];
      let crossed = 0;
      for (let i = 1; i <= 72; i++) {
        const angle = begin + (i * Math.PI) / 36;
        const before = linkwork.frame.crossed;
        for (let k = 0; k < 4; k++) linkwork.change({ do: "pull", grip, to: [Math.cos(angle), Math.sin(angle), 0] });
        if (linkwork.frame.crossed !== before) crossed++;
      }
      return { way: linkwork.frame.values[0][0] - begin, crossed };
    });
    check(Math.abs(turned.way - 2 * Math.PI) < 0.05, `the crank turned by ${turned.way}`);
    check(turned.crossed === 2, `${turned.crossed} dead points were crossed`);
  },

  async "at a dead point the ways on are offered, across it too"() {
    const page = await loaded("mechanisms/four_bar.ron");
    await page.evaluate(() => globalThis.holding.hold("phi1"));
    const before = await values(page);
    for (let i = 1; i <= 40; i++) await page.evaluate((to) => globalThis.linkwork.move("phi1", to), before[2] + 0.05 * i);
    check(/dead point of phi1/.test(await said(page)), `it says: ${await said(page)}`);
    await page.waitForSelector("[data-way='1']");
    // a new drawing has none
    const file = await page.evaluate(() => [globalThis.linkwork.file, globalThis.linkwork.place()]);
    await page.evaluate(() => globalThis.desk.begin());
    await rest(200);
    check((await page.$$("[data-way]")).length === 0, "ways on are offered where nothing is drawn");
    await page.evaluate(([file, place]) => {
      globalThis.desk.open(false);
      globalThis.linkwork.load(file, place);
    }, file);
    for (let i = 1; i <= 10; i++) await page.evaluate(() => globalThis.linkwork.move("phi1", globalThis.linkwork.frame.values[2][0] + 0.05));
    await page.waitForSelector("[data-way='1']");
    const side = ([, phi2]) => Math.sign(Math.sin(phi2));
    await page.click("[data-way='1']");
    check(side(await values(page)) !== side(before), "the way across leads to the same branch");
    check(/across/.test(await page.$eval("#branch", (e) => e.textContent)), "the branch is not said");
    await page.evaluate((to) => globalThis.linkwork.move("phi1", to), before[2]);
    const after = await values(page);
    check(Math.abs(after[2] - before[2]) < 1e-9 && side(after) !== side(before), "the other branch cannot be followed");
  },

  async "a joint at its limit says so by name, and its slider shows it"() {
    const page = await loaded("mechanisms/three_rps.ron");
    for (let i = 0; i < 8; i++) await dragged(page, await corner(page), [0, -60]);
    check(/l\d is at its upper limit of 1\.2 m/.test(await said(page)), `it says: ${await said(page)}`);
    const name = (await said(page)).match(/l\d/)[0];
    check(await page.$eval(`[data-name=${name}][type=range]`, (range) => range.parentElement.classList.contains("limit")), "its slider does not show it");
    const before = await values(page);
    await dragged(page, await corner(page), [0, 60]);
    check((await values(page)).some((value, i) => Math.abs(value - before[i]) > 1e-2), "it is stuck at the limit");
  },

  async "undo and redo go through moves, parameters, what is held and the file; Home goes back"() {
    const page = await loaded("mechanisms/four_bar.ron");
    await rest(400);
    const states = [await values(page)];
    const acts = [
      () => globalThis.linkwork.move("theta1", 2),
      () => globalThis.holding.hold("phi1"),
      () => globalThis.linkwork.set([["l1", "1.2"]]),
      () => globalThis.linkwork.press({ point: "left+0.5", force: [0, -5, 0] }),
    ];
    const state = () => page.evaluate(() => JSON.stringify([globalThis.linkwork.frame.held, globalThis.linkwork.file.set, globalThis.linkwork.pressed]));
    const kept = [await state()];
    for (const act of acts) {
      await page.evaluate(act);
      await rest(400);
      states.push(await values(page));
      kept.push(await state());
    }
    const close = (a, b) => a.every((value, i) => Math.abs(value - b[i]) < 1e-9);
    await page.focus("#canvas");
    for (let i = 3; i >= 0; i--) {
      await page.keyboard.down("Control");
      await page.keyboard.press("z");
      await page.keyboard.up("Control");
      check(close(await values(page), states[i]) && (await state()) === kept[i], `undo ${4 - i} leads to ${await state()}, not ${kept[i]}`);
    }
    for (let i = 1; i <= 4; i++) {
      await page.keyboard.down("Control");
      await page.keyboard.down("Shift");
      await page.keyboard.press("z");
      await page.keyboard.up("Shift");
      await page.keyboard.up("Control");
      check(close(await values(page), states[i]) && (await state()) === kept[i], `redo ${i} leads to ${await state()}, not ${kept[i]}`);
    }
    await page.click("#home");
    check((await held(page)) === "theta1" && Math.abs((await values(page))[0] - Math.PI / 3) < 1e-9, "Home is not home");
  },

  async "z, roll and pitch are held in any order, and the presets hold what they say"() {
    const page = await loaded("mechanisms/three_rps.ron");
    const names = ["top.z", "top.roll", "top.pitch"];
    for (const order of [[0, 1, 2], [0, 2, 1], [1, 0, 2], [1, 2, 0], [2, 0, 1], [2, 1, 0]]) {
      await page.evaluate(() => globalThis.linkwork.home());
      await page.evaluate(() => globalThis.holding.direct());
      for (const i of order) await page.$eval(`[data-name="${names[i]}"][type=checkbox]`, (box) => box.click());
      check((await held(page)) === "top.pitch top.roll top.z", `${order.map((i) => names[i])}: ${await held(page)} are held; ${await said(page)}`);
    }
    // another coordinate depends on these: one must give way, and the page asks which
    await page.$eval("[data-name='top.x'][type=checkbox]", (box) => box.click());
    const choices = await page.$$eval("#ask [data-choice]", (all) => all.map((of) => of.dataset.choice));
    check(choices.length > 1, `choices are ${choices}; ${await said(page)}`);
    await page.click("#ask [data-choice]");
    check((await held(page)).includes("top.x"), `${await held(page)} are held`);
    await page.click("#direct");
    check((await held(page)) === "l1 l2 l3", `direct holds ${await held(page)}`);
    await page.click("[data-inverse=top]");
    check((await held(page)) === "top.pitch top.roll top.z", `inverse holds ${await held(page)}`);
    const hexapod = await loaded("mechanisms/stewart_gough_6ups.ron");
    await hexapod.click("[data-inverse=top]");
    check((await held(hexapod)) === "top.pitch top.roll top.x top.y top.yaw top.z", `inverse holds ${await held(hexapod)}`);
  },

  async "values, parameters and loads take expressions, and sliders of parameters act while they move"() {
    const page = await loaded("mechanisms/four_bar.ron");
    for (const [text, degrees] of [["45 deg", 45], ["80", 80], ["pi/2", 90], ["l1*50 deg", 50], ["30+15", 45], ["sqrt(2)*30", 30 * Math.SQRT2], ["-4e1", -40], ["1,5", 1.5]]) {
      await written(page, "[data-value=theta1]", text);
      const [theta] = await values(page);
      check(Math.abs((theta * 180) / Math.PI - degrees) < 1e-9, `${text} is ${(theta * 180) / Math.PI}°; ${await said(page)}`);
    }
    await written(page, "[data-value=theta1]", "banana");
    check(/banana/.test(await said(page)), `a wrong value is answered by: ${await said(page)}`);
    await written(page, "[data-value=theta1]", "l11*1 deg");
    check(/did you mean `l1`/.test(await said(page)), `a wrong name is answered by: ${await said(page)}`);
    await written(page, "[data-written=l1]", "45 deg");
    check(/^l1 = 45 deg: /.test(await said(page)), `an angle for a length is answered by: ${await said(page)}`);
    await written(page, "[data-written=l1]", "2*0.6");
    check(await page.evaluate(() => globalThis.linkwork.file.set.some(([name, text]) => name === "l1" && text === "2*0.6")), "the parameter is not set");
    // while it is held down nothing but `input` is told
    await page.$eval("[data-parameter=l1]", (range) => {
      range.value = "190";
      range.dispatchEvent(new Event("input"));
    });
    await drawn(page);
    const length = await page.evaluate(() => globalThis.linkwork.mechanism.parameters.find((of) => of.name === "l1").value);
    check(Math.abs(length - 0.95) < 1e-9, `the parameter is ${length} while its slider moves`);
    await written(page, "#loaded", "left");
    await written(page, "[aria-label='Force along y in N']", "-0.006 kN");
    check(await page.evaluate(() => globalThis.linkwork.pressed?.force[1] === -6), "kN is no unit");
    await written(page, "#loaded", "lft");
    const refused = await page.$eval("#load-said", (element) => element.textContent);
    check(refused.includes("did you mean `left`?"), `a wrong point is answered by: ${refused}`);
    await written(page, "#loaded", "left");
    await written(page, "[aria-label='Force along y in N']", "-2*3 N");
    check(await page.evaluate(() => globalThis.linkwork.pressed?.force[1] === -6), "the load is not an expression");
    await written(page, "#watched", "transmision");
    const answer = await page.$eval("#readings-said", (element) => element.textContent);
    check(answer.includes("did you mean `transmission`?"), `a wrong name is answered by: ${answer}`);
  },
};

await run(tests);
