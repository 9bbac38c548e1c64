// What tests read from a canvas: `vicode` on its element.
import { keyOf } from "./scene.js";

export function testApi(canvas) {
  const frame = ({ x, y, w, h }) => ({ x, y, w, h });
  return {
    positions: () => Object.fromEntries([...canvas.scene.nodes.values()].map((node) => [`${node.of}/${node.id}`, frame(node)])),
    selection: () => canvas.selection.items(),
    view: () => ({ x: canvas.viewport.x, y: canvas.viewport.y, k: canvas.viewport.k, far: canvas.isOverview, resting: canvas.viewport.isIdle }),
    setView: (view) => canvas.viewport.set(view),
    screen: (of, id) => {
      const element = canvas.scene.find(keyOf(of, id));
      const at = canvas.viewport.toScreen(canvas.scene.nameOf(element.key) ?? canvas.router.route(element).at);
      const box = canvas.stage.getBoundingClientRect();
      return { x: at.x + box.left, y: at.y + box.top };
    },
    names: () => canvas.levelOfDetail.names.shown,
    mounted: () => canvas.painter.items.size,
  };
}
