// Pictures to take away: SVG as `linkwork draw` makes it, PNG and GLB of what is shown.
import { GLTFExporter } from "three/addons/exporters/GLTFExporter.js";
import { Group, Mesh, type MeshLambertMaterial, MeshStandardMaterial, Scene, Vector3 } from "three";
import { download } from "./editor";
import { button, find } from "./elements";
import type { Model } from "./model";
import type { Stage } from "./stage";

export function exporting(model: Model, stage: Stage, solids: () => Group, inPlane: () => boolean, labels: () => boolean) {
  const name = (ending: string) => `${(model.file.file || "mechanism").replace(/\.ron$/, "")}.${ending}`;
  const svg = () => {
    const [x, y, z] = stage.camera.getWorldDirection(new Vector3()).negate().toArray();
    const from: [number, number] | null = inPlane() ? null : [Math.atan2(y, x), Math.asin(z)];
    try {
      const picture = model.ask<{ svg: string }>({ do: "picture", from, labels: labels() });
      download(name("svg"), picture.svg, "image/svg+xml");
    } catch (error) {
      model.refuse(error);
    }
  };
  const png = () => {
    stage.drawNow();
    stage.canvas.toBlob((blob) => blob && download(name("png"), blob, "image/png"));
  };
  const glb = async () => {
    const world = new Scene();
    for (const solid of solids().children) {
      if (!(solid instanceof Mesh) || !solid.visible) continue;
      const { color, opacity, transparent, side } = solid.material as MeshLambertMaterial;
      const copy = new Mesh(solid.geometry, new MeshStandardMaterial({ color, opacity, transparent, side, roughness: 0.7 }));
      copy.applyMatrix4(solid.matrix);
      world.add(copy);
    }
    // glTF has y upwards
    world.rotation.x = -Math.PI / 2;
    const content = await new GLTFExporter().parseAsync(world, { binary: true });
    download(name("glb"), content as ArrayBuffer, "model/gltf-binary");
  };
  find("export").append(button("SVG", svg), " ", button("PNG", png), " ", button("GLB", () => void glb()));
}
