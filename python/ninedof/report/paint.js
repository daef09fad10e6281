// The machine on a canvas, from the back to the front.

const KINDS = ["l", "q", "r"];
const PARTS = 6; // of a leg, so that legs that cross are drawn in the right order

// Joints in base axes: base, platform, O; and the two ends of each leg.
function placed(machine, pose) {
  const move = (u) => pose.q.map((row, k) => pose.p[k] + dot(row, u));
  const platform = machine.platform.map(move), o = pose.s, base = machine.base;
  const legs = [0, 1, 2].map((i) => ["l", i, base[i], platform[i]]);
  legs.push(...[0, 1, 2].map((i) => ["q", i, o, platform[3 + i]]), ...[0, 1, 2].map((i) => ["r", i, base[3 + i], o]));
  const tool = machine.plateOrigin ? [move(machine.plateOrigin), pose.p] : [];
  return { base, platform, o, legs, tool, plate: machine.platformPlate.map((face) => face.map(move)) };
}

function paint(context, size, camera, data, machine, pose, shown, colours) {
  const [width, height] = size, view = camera.frame(width, height), { project } = view;
  const robot = placed(machine, pose);
  const line = (points, colour, thick, dash = []) => {
    context.beginPath();
    points.forEach((p, k) => (k ? context.lineTo(p[0], p[1]) : context.moveTo(p[0], p[1])));
    Object.assign(context, { strokeStyle: colour, lineWidth: thick });
    context.setLineDash(dash);
    context.stroke();
    context.setLineDash([]);
  };
  const disc = (p, r, fill, edge, thick) => {
    context.beginPath();
    context.arc(p[0], p[1], r, 0, 2 * Math.PI);
    Object.assign(context, { fillStyle: fill, strokeStyle: edge, lineWidth: thick });
    context.fill();
    context.stroke();
  };
  const plate = (faces, colour, joints) => {
    const order = faces.map((face) => face.map(project)).sort((a, b) => a[0][2] - b[0][2]);
    for (const face of order) {
      context.globalAlpha = 0.82;
      polygon(context, face, colour);
      context.globalAlpha = 1;
      line([...face, face[0]], colours.ink, 0.9);
    }
    joints.map(project).forEach((p) => disc(p, 3.6, colours.ink, colours.surface, 1.1));
  };
  // A plate seen from outside covers what lies between the plates; seen from inside it is behind it.
  const normal = [0, 1, 2].map((k) => pose.q[k][2]);
  const overBase = view.eye[2] > machine.base[0][2], overPlatform = dot(minus(view.eye, pose.p), normal) > 0;
  const base = () => plate(machine.basePlate, colours.base, robot.base);
  const platform = () => plate(robot.plate, colours.platform, robot.platform);

  context.clearRect(0, 0, width, height);
  Object.assign(context, { lineJoin: "round", lineCap: "butt" });
  floor(data.floor, project, line, colours);
  if (overBase) base();
  if (!overPlatform) platform();
  between_plates(context, data.radius, shown.region ? machine.region : [], robot, view, colours, line);
  if (overPlatform) platform();
  if (!overBase) base();
  if (machine.body && shown.body) body(context, size, machine.body, view, colours);
  if (shown.labels) labels(context, robot, project, colours, line, machine.basePlate.map((face) => face.map(project)));
  axes(context, view, height, colours, line);
}

function polygon(context, points, colour) {
  context.beginPath();
  points.forEach((p, k) => (k ? context.lineTo(p[0], p[1]) : context.moveTo(p[0], p[1])));
  context.fillStyle = colour;
  context.fill();
}

function floor({ step, count }, project, line, colours) {
  for (let k = -count; k <= count; k++) {
    const [a, b] = [k * step, count * step];
    line([[a, -b, 0], [a, b, 0]].map(project), colours.line, k ? 0.6 : 1.1);
    line([[-b, a, 0], [b, a, 0]].map(project), colours.line, k ? 0.6 : 1.1);
  }
}

// Legs with a rim where one crosses another, the region, and O; sorted by depth.
function between_plates(context, radius, region, robot, view, colours, line) {
  const items = [];
  for (const [kind, , a, b] of robot.legs) {
    for (let k = 0; k < PARTS; k++) {
      const ends = [between(a, b, k / PARTS), between(a, b, (k + 1) / PARTS)].map(view.project);
      items.push([(ends[0][2] + ends[1][2]) / 2, () => {
        const thick = kind === "l" ? 4 : 3.2;
        line(ends, colours.surface, thick + 2.4);
        context.lineCap = "round";
        line(ends, colours[kind], thick);
        context.lineCap = "butt";
      }]);
    }
  }
  for (const points of region) {
    for (let k = 1; k < points.length; k++) {
      const ends = [points[k - 1], points[k]].map(view.project);
      items.push([(ends[0][2] + ends[1][2]) / 2, () => line(ends, colours.region, 1.6, [5, 3])]);
    }
  }
  if (robot.tool.length) {
    const [plate, tip] = robot.tool.map(view.project);
    const point = [[-5, -5], [5, -5], [0, 4]].map(([x, y]) => [tip[0] + x, tip[1] + y]);
    items.push([tip[2], () => (line([plate, tip], colours.region, 2.4), polygon(context, point, colours.region))]);
  }
  const o = view.project(robot.o);
  // A diamond: a ring beside the letter O would be read as a second one.
  items.push([o[2] + 0.02 * radius, () => {
    const corners = [[5.5, 0], [0, 5.5], [-5.5, 0], [0, -5.5]].map(([x, y]) => [o[0] + x, o[1] + y]);
    polygon(context, corners, colours.ink);
    line([...corners, corners[0]], colours.surface, 1);
  }]);
  items.sort((a, b) => a[0] - b[0]).forEach((item) => item[1]());
}

// The surface is drawn opaque on a canvas of its own and laid over the picture like glass.
function body(context, [width, height], { vertices, faces }, view, colours) {
  const spare = document.createElement("canvas"), ratio = context.getTransform().a;
  [spare.width, spare.height] = [width * ratio, height * ratio];
  const glass = spare.getContext("2d");
  glass.scale(ratio, ratio);
  const points = vertices.map(view.project);
  const order = faces.map((face, k) => [face.reduce((sum, v) => sum + points[v][2], 0), k]).sort((a, b) => a[0] - b[0]);
  for (const [, k] of order) {
    const [a, b, c, d] = faces[k].map((v) => vertices[v]);
    const facing = dot(unit(cross(minus(c, a), minus(d, b))), view.toward);
    if (facing < 0) continue;
    glass.fillStyle = glass.strokeStyle = `hsl(${colours.hue} 45% ${(100 * (0.34 + 0.42 * facing)).toFixed(1)}%)`;
    glass.beginPath();
    faces[k].forEach((v, n) => (n ? glass.lineTo(points[v][0], points[v][1]) : glass.moveTo(points[v][0], points[v][1])));
    glass.closePath();
    glass.fill();
    glass.stroke();
  }
  context.globalAlpha = 0.5;
  context.drawImage(spare, 0, 0, width, height);
  context.globalAlpha = 1;
}

// The name of each leg beside it on light ground, off the base where there is room, else at the end of a thin line.
function labels(context, robot, project, colours, line, dark) {
  const o = project(robot.o), taken = [[o[0], o[1], 8]]; // middles and widths: of the mark of O, then of the names
  Object.assign(context, { textAlign: "center", textBaseline: "middle" });
  const light = ([x, y]) => !dark.some((face) => within(face, x, y));
  const write = (text, colour, places, font = "600 12px system-ui, sans-serif") => {
    context.font = font;
    const wide = Math.max(18, context.measureText(text).width + 4);
    const free = ([x, y]) => taken.every(([a, b, w]) => Math.abs(a - x) > (w + wide) / 2 - 1 || Math.abs(b - y) > 14);
    const [x, y] = places[0], around = [26, 40, 56, 76].flatMap((r) =>
      [...Array(16).keys()].map((k) => [x + r * Math.cos(k * Math.PI / 8), y + r * Math.sin(k * Math.PI / 8)]));
    const at = places.find((p) => free(p) && light(p)) || places.find(free) || around.find(free) || places[0];
    if (around.includes(at)) line([[x, y], at], colour, 0.8);
    taken.push([...at, wide]);
    context.fillStyle = colours.surface;
    context.globalAlpha = 0.85;
    context.fillRect(at[0] - wide / 2, at[1] - 8, wide, 16);
    context.globalAlpha = 1;
    context.fillStyle = colour;
    context.fillText(text, at[0], at[1]);
  };
  write("O", colours.ink, [[o[0] - 17, o[1] - 3], [o[0] + 17, o[1] - 3], [o[0], o[1] + 18]], "italic 600 13px system-ui, sans-serif");
  for (const [kind, i, a, b] of [...robot.legs.slice(3), ...robot.legs.slice(0, 3)]) { // the short ones first
    const [from, to] = [a, b].map(project), long = Math.hypot(to[0] - from[0], to[1] - from[1]) || 1;
    const aside = long < 90 ? [12, -12, 22, -22] : [0]; // in pixels; beside a leg that its number would hide
    const across = [(from[1] - to[1]) / long, (to[0] - from[0]) / long];
    const places = [0.5, 0.6, 0.4, 0.7, 0.3, 0.8, 0.2].flatMap((t) => {
      const [x, y] = project(between(a, b, t));
      return aside.map((d) => [x + d * across[0], y + d * across[1]]);
    });
    write(`${kind}${i + 1}`, colours[kind], places);
  }
  if (robot.tool.length) {
    const [x, y] = project(robot.tool[1]);
    write("tool", colours.region, [[x + 22, y], [x - 22, y], [x, y + 17]]);
  }
}

function within(face, x, y) {
  let inside = false;
  face.forEach(([a, b], k) => {
    const [c, d] = face[(k + 1) % face.length];
    if (b > y !== d > y && x < a + (y - b) / (d - b) * (c - a)) inside = !inside;
  });
  return inside;
}

function axes(context, view, height, colours, line) {
  const origin = [34, height - 30];
  ["x", "y", "z"].forEach((name, k) => {
    const end = [origin[0] + 22 * view.right[k], origin[1] - 22 * view.up[k]];
    line([origin, end], colours.muted, 1.4);
    Object.assign(context, { fillStyle: colours.muted, font: "11px system-ui, sans-serif", textAlign: "center", textBaseline: "middle" });
    if (Math.hypot(view.right[k], view.up[k]) > 0.25) {
      context.fillText(name, origin[0] + 30 * view.right[k], origin[1] - 30 * view.up[k]);
    }
  });
}
