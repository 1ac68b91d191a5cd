// The outline of a body: the corners of the convex hull of its points.

/** Numbers of the points of a plane that are corners of their convex hull, in order round it (A. Andrew 1979). */
export function hull(points: readonly (readonly [number, number])[]): number[] {
  const order = points.map((_, i) => i).toSorted((a, b) => points[a]![0] - points[b]![0] || points[a]![1] - points[b]![1]);
  const side = (along: number[]): number[] => {
    const corners: number[] = [];
    for (const i of along) {
      while (corners.length > 1 && !leftOf(points[corners.at(-2)!]!, points[corners.at(-1)!]!, points[i]!)) corners.pop();
      corners.push(i);
    }
    return corners.slice(0, -1);
  };
  return [...side(order), ...side(order.toReversed())];
}

/** Whether a way turns to the left at its second point, by more than rounding. */
function leftOf(a: readonly [number, number], b: readonly [number, number], c: readonly [number, number]): boolean {
  const [x, y, u, v] = [b[0] - a[0], b[1] - a[1], c[0] - a[0], c[1] - a[1]];
  return x * v - y * u > 1e-9 * Math.hypot(x, y) * Math.hypot(u, v);
}
