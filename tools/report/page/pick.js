// What a click means.
import { firstHit, intoBody, outOfBody } from './shapes.js';

/**
 * What a ray meets first: {at, ...what the target tells}, or null. What is solid goes before what is translucent: behind
 * a bone that lets the tissue be seen, the tissue is meant.
 * @param targets [{actor, points, triangles, pose, tell(hit)}]
 * @param isKept(point) whether a place is on the side of a cut that is drawn
 */
export function firstTarget(origin, direction, targets, isKept) {
  const hits = [];
  for (const { actor, points, triangles, pose, tell } of targets) {
    if (!actor.getVisibility()) continue;
    const hit = firstHit(intoBody(pose, origin, 1), intoBody(pose, direction, 0), points, triangles, (x) => isKept(outOfBody(pose, x)));
    if (hit) hits.push({ ...tell(hit), distance: hit.distance, isSolid: actor.getProperty().getOpacity() > 0.5 });
  }
  hits.sort((a, b) => b.isSolid - a.isSolid || a.distance - b.distance);
  if (hits.length === 0) return null;
  return { ...hits[0], at: origin.map((x, k) => x + hits[0].distance * direction[k]) };
}
