// What tests and benchmarks read of a canvas: `element.vicode`.
import { keyOf } from "./scene.js";

export function testInterface({ scene, router, stage, selection, viewport, levelOfDetail, painter }) {
  const frame = ({ x, y, w, h }) => ({ x, y, w, h });
  return {
    positions: () => Object.fromEntries([...scene.nodes.values()].map((node) => [`${node.of}/${node.id}`, frame(node)])),
    selection: () => selection.items(),
    view: () => ({ x: viewport.x, y: viewport.y, k: viewport.k, far: levelOfDetail.far, resting: viewport.isIdle }),
    setView: (view) => viewport.set(view),
    screen: (of, id) => {
      const element = scene.find(keyOf(of, id));
      const at = viewport.toScreen(scene.nameOf(element.key) ?? router.route(element).at);
      const box = stage.getBoundingClientRect();
      return { x: at.x + box.left, y: at.y + box.top };
    },
    mounted: () => painter.items.size,
  };
}
