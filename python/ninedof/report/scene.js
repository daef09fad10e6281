// The view: its data, its controls, and when it is drawn.

(() => {
  const data = JSON.parse(document.getElementById("scene-data").textContent);
  const box = document.getElementById("view");
  if (!data || !box) return;
  const canvas = box.querySelector("canvas"), context = canvas.getContext("2d");
  const [machines, poses] = [...box.querySelectorAll("select")];
  const shown = { labels: true, region: true, body: true };
  let machine = data.machines[data.start], pose = machine.poses[0], waiting = false;
  box.hidden = false;

  const camera = new Camera(...extent());
  data.radius = camera.start.radius;
  data.floor = squares();

  function extent() {
    const reached = (m) => m.poses.map((p) => placed(m, p)).flatMap((robot) => [...robot.platform, ...robot.tool]);
    const points = data.machines.flatMap((m) => [...m.base, ...reached(m)]);
    points.push(...data.machines.flatMap((m) => (m.body ? m.body.vertices : [])));
    const low = [0, 1, 2].map((k) => Math.min(...points.map((p) => p[k])));
    const high = [0, 1, 2].map((k) => Math.max(...points.map((p) => p[k])));
    const centre = between(low, high, 0.5), away = (p) => Math.hypot(p[0] - centre[0], p[1] - centre[1]);
    return [centre, Math.max(...points.map(away)) || 1, 0.5 * (high[2] - low[2])];
  }

  function squares() {
    const wanted = data.radius / 4, power = 10 ** Math.floor(Math.log10(wanted));
    const step = [1, 2, 5, 10].find((k) => k * power >= wanted) * power;
    const reach = Math.max(...data.machines.flatMap((m) => m.base.map((p) => Math.hypot(p[0], p[1]))));
    return { step, count: Math.ceil(reach / step) };
  }

  function colours() {
    const style = getComputedStyle(document.documentElement);
    const names = ["ink", "muted", "line", "surface", "base", "platform", "region", "hue", ...KINDS];
    return Object.fromEntries(names.map((name) => [name, style.getPropertyValue(`--${name}`).trim()]));
  }

  function draw() {
    waiting = false;
    const paper = "print" in document.documentElement.dataset; // scaled there to what room it has
    const [width, height] = paper ? [760, 311] : [canvas.clientWidth, canvas.clientHeight];
    const ratio = Math.max(paper ? 2.5 : 1, Math.min(window.devicePixelRatio || 1, 3));
    if (!width) return;
    if (canvas.width !== Math.round(width * ratio) || canvas.height !== Math.round(height * ratio)) {
      [canvas.width, canvas.height] = [Math.round(width * ratio), Math.round(height * ratio)];
    }
    context.setTransform(ratio, 0, 0, ratio, 0, 0);
    paint(context, [width, height], camera, data, machine, pose, shown, colours());
  }

  const redraw = () => {
    if (!waiting) requestAnimationFrame(draw);
    waiting = true;
  };

  function options(select, items) {
    select.replaceChildren(...items.map((item, k) => new Option(item.name, k)));
    select.parentElement.hidden = items.length < 2;
  }

  function tell() {
    const rows = KINDS.map((kind, row) => {
      const line = document.createElement("tr"), head = document.createElement("th");
      Object.assign(head, { textContent: kind, className: kind });
      line.append(head, ...[0, 1, 2].map((i) => Object.assign(document.createElement("td"), { textContent: pose.lengths[3 * row + i] })));
      return line;
    });
    document.getElementById("lengths").replaceChildren(...rows);
    document.getElementById("kappa").textContent = `condition number ${pose.kappa}`;
    box.querySelector("[data-show=region]").parentElement.hidden = !machine.region.length;
    box.querySelector("[data-show=body]").parentElement.hidden = !machine.body;
    document.getElementById("which").textContent = `${machine.name}, ${pose.name}`;
    redraw();
  }

  machines.addEventListener("change", () => {
    machine = data.machines[machines.value];
    pose = machine.poses[0];
    options(poses, machine.poses);
    tell();
  });
  poses.addEventListener("change", () => ((pose = machine.poses[poses.value]), tell()));
  for (const button of box.querySelectorAll("[data-view]")) {
    button.addEventListener("click", () => {
      camera.look(button.dataset.view);
      redraw();
    });
  }
  for (const button of box.querySelectorAll("[data-zoom]")) {
    button.addEventListener("click", () => (zoom(camera, Number(button.dataset.zoom)), redraw()));
  }
  for (const input of box.querySelectorAll("[data-show]")) {
    input.addEventListener("change", () => ((shown[input.dataset.show] = input.checked), redraw()));
  }
  document.getElementById("grid").textContent = `Leg lengths${data.unit && ` in ${data.unit}`}. Squares on the floor: ${Number(data.floor.step.toPrecision(3))} ${data.unit}`;
  options(machines, data.machines);
  machines.value = data.start;
  options(poses, machine.poses);
  listen(canvas, camera, redraw);
  new ResizeObserver(redraw).observe(canvas);
  matchMedia("(prefers-color-scheme: dark)").addEventListener("change", redraw);
  addEventListener("beforeprint", () => ((document.documentElement.dataset.print = ""), draw()));
  addEventListener("afterprint", () => (delete document.documentElement.dataset.print, draw()));
  tell();
  draw();
  document.documentElement.dataset.scene = "ready";
})();
