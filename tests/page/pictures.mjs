// Pictures that read: the base is seen, symbols stand at their links from everywhere, everything is in the picture, and
// many assemblies become few poses.
import { check, drawn, loaded, opened, run } from "./harness.mjs";

const rest = (ms) => new Promise((done) => setTimeout(done, ms));

const tests = {
  async "planar symbols stand at their links from every side"() {
    const page = await loaded("mechanisms/jansen_leg.ron");
    for (const view of ["plane", "iso", "front", "top"]) {
      await page.click(`[data-view=${view}]`);
      await drawn(page);
      // what is picked at a pin as it is seen is that pin, or a link that covers it
      const missed = await page.evaluate(() => {
        const { picture, linkwork } = globalThis;
        const box = picture.stage.canvas.getBoundingClientRect();
        return linkwork.frame.scene.joints.filter((joint) => {
          const [x, y] = picture.pixel(joint.at);
          return !picture.stage.hits({ clientX: box.left + x, clientY: box.top + y }).length;
        }).length;
      });
      check(missed === 0, `${missed} pins float away from their links in the view ${view}`);
    }
  },

  async "the base of a platform is a body, with ground under it, and a plane has none"() {
    const plates = (page) => page.evaluate(() => {
      const { drawing, surroundings } = globalThis.picture;
      const visible = drawing.shapes.group.children.filter((mesh) => mesh.visible && mesh.material.transparent && mesh.userData.body !== undefined);
      return [visible.map((mesh) => mesh.userData.body), surroundings.group.visible];
    });
    const platform = await loaded("mechanisms/stewart_gough_6ups.ron");
    const [bodies, ground] = await plates(platform);
    check(bodies.includes(0) && ground, `plates of bodies ${bodies}, ground ${ground}`);
    const planar = await loaded("mechanisms/planar_3rpr.ron");
    check(!(await plates(planar))[1], "a plane is seen with a ground plane");
    await planar.click("[data-view=iso]");
    await drawn(planar);
    check((await plates(planar))[1], "from the side there is no ground plane");
  },

  async "Fit brings the mechanism, its motion and its paths into the picture, in perspective too"() {
    const page = await loaded("mechanisms/hoeken.ron");
    await page.evaluate(() => {
      document.getElementById("traced").value = "left+2.5";
      document.getElementById("sweep").click();
    });
    await page.waitForSelector("#play:not([disabled])", { timeout: 60_000 });
    for (const perspective of [false, true]) {
      await page.click("[data-view=iso]");
      if (perspective) await page.evaluate(() => [...document.querySelectorAll("#views button")].find((of) => of.textContent === "Perspective").click());
      await page.evaluate(() => globalThis.picture.stage.zoom(5));
      await page.evaluate(() => globalThis.picture.fit());
      await drawn(page);
      const outside = await page.evaluate(() => {
        const { picture } = globalThis;
        const { clientWidth, clientHeight } = picture.stage.canvas;
        return picture.scenery.traces.flatMap((trace) => trace.points).filter((at) => {
          const [x, y] = picture.pixel(at);
          return !(x > 0 && x < clientWidth && y > 0 && y < clientHeight);
        }).length;
      });
      check(outside === 0, `${outside} places of the path are outside${perspective ? " in perspective" : ""}`);
    }
    // a body is taken hold of where it is seen, in perspective too
    const hit = await page.evaluate(() => {
      const { picture } = globalThis;
      const box = picture.stage.canvas.getBoundingClientRect();
      const [x, y] = picture.pixelOf("left.1");
      return picture.stage.hits({ clientX: box.left + x, clientY: box.top + y })[0]?.pick ?? null;
    });
    check(hit !== null, "nothing is taken hold of in perspective");
    await page.evaluate(() => [...document.querySelectorAll("#views button")].find((of) => of.textContent === "Perspective").click());
  },

  async "assemblies of a platform are few poses with pictures, their legs folded away"() {
    const page = await loaded("mechanisms/stewart_gough_6ups.ron");
    await page.click("#list-modes");
    await page.waitForSelector("#mode-list li", { timeout: 300_000 });
    await rest(500);
    const listed = await page.evaluate(() => {
      const { states } = globalThis.modes.found;
      const key = ({ at }) => JSON.stringify(at.platforms.map(([position]) => position.map((x) => Math.round(x * 1e4))));
      return { all: states.length, poses: new Set(states.map(key)).size, shown: document.querySelectorAll("#mode-list > li").length, buttons: document.querySelectorAll("#mode-list button").length };
    });
    console.log(`    ${JSON.stringify(listed)}`);
    check(listed.shown === listed.poses && listed.buttons === listed.poses, JSON.stringify(listed));
    const inked = await page.$$eval("#mode-list canvas", (all) => all.map((canvas) => canvas.getContext("2d").getImageData(0, 0, canvas.width, canvas.height).data.some((x) => x > 0)));
    check(inked.every(Boolean), `pictures: ${inked}`);
    if (listed.all > listed.poses) {
      await page.$eval("#mode-list details", (fold) => (fold.open = true));
      await rest(100);
      const variants = await page.$$eval("#mode-list .variants button", (all) => all.length);
      check(variants > 1, `${variants} variants`);
      await page.$eval("#mode-list .variants button:last-of-type", (go) => go.click());
    }
    // one ghost at a time, under the pointer
    await page.hover("#mode-list li:last-child > button");
    check((await page.evaluate(() => globalThis.picture.scenery.ghosts.length)) === 1, "there is not one ghost");
    // with the mechanism beside it
    const outside = await page.evaluate(() => {
      const { picture, linkwork } = globalThis;
      const { clientWidth, clientHeight } = picture.stage.canvas;
      const all = [linkwork.frame.scene, ...picture.scenery.ghosts].flatMap((scene) => scene.bodies.flatMap((body) => body.corners));
      return all.map((at) => picture.pixel(at)).filter(([x, y]) => !(x > 0 && x < clientWidth && y > 0 && y < clientHeight)).length;
    });
    check(outside === 0, `${outside} corners are outside the picture beside a ghost`);
  },

  async "the gallery is in topics, is searched, and folds cuts of one mechanism together"() {
    const page = await opened("");
    await page.waitForSelector("#gallery[open]");
    const topics = await page.$$eval("#gallery h2", (all) => all.map((of) => of.textContent));
    check(topics.length >= 5, `${topics}`);
    check((await page.$$eval("#gallery details button", (all) => all.map((of) => of.dataset.file))).includes("four_bar_cut1.ron"), "cuts are not folded");
    await page.type("#gallery-search", "hexapod");
    await page.$eval("#gallery-search", (field) => (field.value = ""));
    await page.type("#gallery-search", "jansen");
    const found = await page.$$eval("#gallery-items button:not([hidden])", (all) => all.map((of) => of.dataset.file));
    check(found.includes("jansen_leg.ron") && found.length < 6, `found are ${found}`);
    await page.type("#gallery-search", "zzz");
    check(/No mechanism has “jansenzzz”/.test(await page.$eval("#gallery-said", (of) => of.textContent)), "nothing is said where nothing is found");
    await page.close();
  },

  async "arrows of reactions stay in the picture, near a dead point too"() {
    const page = await loaded("mechanisms/four_bar.ron");
    await page.evaluate(() => globalThis.holding.hold("phi1"));
    await page.evaluate(() => globalThis.linkwork.press({ point: "left+0.5", force: [0, -5, 0] }));
    for (let i = 0; i < 40; i++) await page.evaluate(() => globalThis.linkwork.move("phi1", globalThis.linkwork.frame.values[2][0] + 0.05));
    await rest(700);
    const outside = await page.evaluate(() => {
      const { picture, linkwork } = globalThis;
      const [above] = picture.stage.covered();
      const { clientWidth, clientHeight } = picture.stage.canvas;
      return linkwork.frame.scene.arrows.filter((arrow) => {
        const [x, y] = picture.stage.pixel(picture.scenery.arrows.tip(arrow));
        return !(x > 0 && x < clientWidth && y > above - 14 && y < clientHeight);
      }).length;
    });
    check(outside === 0, `${outside} arrows leave the picture`);
    await page.evaluate(() => globalThis.linkwork.press(null));
  },

  async "a spatial loop has a bar from bearing to bearing, and what is behind the base can be taken hold of"() {
    const page = await loaded("mechanisms/bennett.ron");
    const bars = await page.evaluate(() => globalThis.picture.drawing.shapes.group.children.filter((mesh) => mesh.visible && mesh.userData.body === 0).length);
    check(bars > 0, "the ground link is not drawn");
    const platform = await loaded("mechanisms/three_rps.ron");
    await platform.click("[data-view=top]");
    await drawn(platform);
    const picks = await platform.evaluate(() => {
      const { picture, linkwork } = globalThis;
      const plate = linkwork.frame.scene.bodies.find((body) => body.platform);
      const middle = plate.corners[0].map((_, i) => plate.corners.reduce((sum, p) => sum + p[i] / plate.corners.length, 0));
      const box = picture.stage.canvas.getBoundingClientRect();
      const [x, y] = picture.pixel(middle);
      return picture.stage.hits({ clientX: box.left + x, clientY: box.top + y }).map(({ pick }) => pick.body);
    });
    check(picks[0] === 1 && picks.includes(0), `under the pointer are ${picks}`);
  },

  async "names stand clear of pins"() {
    const page = await loaded("mechanisms/stephenson_six_bar.ron");
    await page.evaluate(() => [...document.querySelectorAll("#views button")].find((of) => of.textContent === "Names").click());
    await drawn(page);
    const covered = await page.evaluate(() => {
      const { picture, linkwork } = globalThis;
      const box = picture.stage.canvas.getBoundingClientRect();
      const spans = [...document.querySelectorAll("#labels span:not([hidden])")].map((of) => of.getBoundingClientRect());
      const pins = linkwork.frame.scene.joints.map((joint) => picture.pixel(joint.at));
      return pins.filter(([x, y]) => spans.some((of) => box.x + x > of.left && box.x + x < of.right && box.y + y > of.top && box.y + y < of.bottom)).length;
    });
    check(covered === 0, `${covered} pins are under names`);
    await page.evaluate(() => [...document.querySelectorAll("#views button")].find((of) => of.textContent === "Names").click());
  },
};

await run(tests);
