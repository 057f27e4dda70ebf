// Draws the charts of the page from the records in it and makes its picture strips comparable.
// Tables, bars, histograms and pictures need no script. What came out is written to data attributes
// of the root element, which the tests read: charts, drawn, errors, overflow, background.
"use strict";
(() => {
  const root = document.documentElement;
  const errors = [];
  window.addEventListener("error", (event) => {
    errors.push(event.message);
    root.dataset.errors = errors.length;
  });

  const records = JSON.parse(document.getElementById("records").textContent);
  const colour = (name) => getComputedStyle(root).getPropertyValue(name).trim();
  const palette = ["#2b8cbe", "#d1792b", "#8c6bb1", "#3a9d6b", "#c2527f", "#a08a1f", "#7b8794", "#c0503c", "#4c6fd1", "#6b9e2f"];
  const charts = [];

  const setTheme = () => {
    Chart.defaults.color = colour("--soft");
    Chart.defaults.borderColor = colour("--line");
    Chart.defaults.font.family = getComputedStyle(document.body).fontFamily;
  };
  Chart.defaults.animation = false;
  Chart.defaults.maintainAspectRatio = false;
  Chart.defaults.datasets.line.borderWidth = 2;

  // 1, 2 and 5 times powers of ten, without exponents where that is short.
  const logTick = (value) => {
    const digit = value / 10 ** Math.floor(Math.log10(value) + 1e-9);
    if (![1, 2, 5].some((d) => Math.abs(digit - d) < 1e-6)) return "";
    return value >= 1e-3 && value < 1e5 ? String(+value.toPrecision(3)) : value.toExponential(0);
  };
  const logAxis = (text, values) => {
    const min = Math.min(...values) * 0.7, max = Math.max(...values) * 1.5;
    const decades = Math.log10(max / min);
    const tick = (value) => (decades < 3 || Number.isInteger(+Math.log10(value).toFixed(6)) ? logTick(value) : "");
    return {
      type: "logarithmic", min, max,
      title: { display: true, text },
      ticks: { callback: tick, maxRotation: 0, autoSkip: false },
    };
  };
  const short = (value) => String(+value.toPrecision(3));

  // Names beside the Pareto points, each moved until it meets no other and tied to its point if that is far.
  const pointNames = {
    id: "pointNames",
    afterDatasetsDraw(chart) {
      const at = chart.data.datasets.findIndex((set) => set.pareto);
      if (at < 0) return;
      const { ctx, chartArea: area } = chart;
      const boxes = [];
      ctx.save();
      ctx.font = `600 12px ${Chart.defaults.font.family}`;
      ctx.textBaseline = "middle";
      // Points that cannot be told apart share a name, the default's if it is among them.
      const points = chart.getDatasetMeta(at).data.map((point, i) => ({
        x: point.x, y: point.y, name: chart.data.datasets[at].data[i].name, alike: 0,
      }));
      const named = [];
      points.sort((a, b) => (b.name === "default") - (a.name === "default"));
      points.forEach((point) => {
        const same = named.find((other) => Math.hypot(other.x - point.x, other.y - point.y) < 10);
        if (same) ++same.alike;
        else named.push(point);
      });
      named.forEach((point) => {
        const name = point.name + (point.alike > 0 ? ` and ${point.alike} alike` : "");
        const width = ctx.measureText(name).width;
        let x = point.x + 9;
        if (x + width > area.right) x = Math.max(area.left, point.x - 9 - width);
        const meets = (y) => boxes.some((b) => x < b.right && x + width > b.left && Math.abs(y - b.y) < 14);
        let y = point.y - 9;
        for (let step = 1; meets(y) && step < 30; ++step) y = point.y - 9 + (step % 2 ? -7 : 7) * (step + 1);
        y = Math.min(Math.max(y, area.top + 8), area.bottom - 8);
        boxes.push({ left: x, right: x + width, y });
        if (Math.abs(y - point.y) > 16) {
          ctx.beginPath();
          ctx.moveTo(point.x, point.y + 9 * Math.sign(y - point.y));
          ctx.lineTo(x + (x > point.x ? 6 : width - 6), y - 7 * Math.sign(y - point.y));
          ctx.strokeStyle = colour("--soft");
          ctx.lineWidth = 1;
          ctx.stroke();
        }
        ctx.strokeStyle = colour("--panel");
        ctx.lineWidth = 4;
        ctx.lineJoin = "round";
        ctx.strokeText(name, x, y);
        ctx.fillStyle = colour("--ink");
        ctx.fillText(name, x, y);
      });
      ctx.restore();
    },
  };

  // Cases "group/knob=value": error over cost, a series per knob, the front on top. Which metrics
  // these are and what they are called stands with the canvas.
  const tradeOffChart = (canvas) => {
    const { table, prefix, cost, error, noise: noiseMetric, optimal, costTitle, errorTitle, noiseTitle, tip } =
      canvas.dataset;
    const points = new Map();
    for (const r of records) {
      if (r.table !== table || !r.case.startsWith(prefix)) continue;
      const name = r.case.slice(prefix.length);
      if (name.includes("/")) continue; // of one scene, or one kind of pixels
      if (!points.has(name)) points.set(name, { name, knob: name.split("=")[0] });
      const point = points.get(name);
      point[r.metric] = r.median;
      if (r.config && r.config.role) point.role = r.config.role;
    }
    const all = [...points.values()]
      .filter((p) => p[cost] > 0 && p[error] > 0)
      .map((p) => ({ ...p, x: p[cost], y: p[error] }));
    // The default stands under every knob that has it, but is one point of the front.
    const standard = all.find((p) => p.role === "default");
    const front = all
      .filter((p) => p[optimal] === 1 && (p.role !== "default" || p === standard))
      .map((p) => (p === standard ? { ...p, name: "default" } : p))
      .sort((a, b) => a.x - b.x);
    const knobs = [...new Set(all.map((p) => p.knob))];
    const datasets = [{
      label: "Pareto front", data: front, pareto: true, showLine: true, borderColor: colour("--ink"),
      borderWidth: 1.5, borderDash: [5, 4], pointRadius: 9, pointHoverRadius: 9, pointBorderWidth: 1.5,
      pointBackgroundColor: "transparent", pointBorderColor: colour("--ink"), order: 1,
    }];
    knobs.forEach((knob, i) => {
      const data = all.filter((p) => p.knob === knob);
      const rival = data.some((p) => p.role === "rival" || p.role === "sampled");
      const inOrder = data.length > 2 && data.every((p) => Number.isFinite(Number(p.name.slice(knob.length + 1))));
      datasets.push({
        label: rival ? `${knob} (rival)` : knob, data, showLine: inOrder, borderWidth: 1.5,
        borderColor: palette[i % palette.length], backgroundColor: palette[i % palette.length],
        pointRadius: 5, pointHoverRadius: 7, pointStyle: rival ? "rectRot" : "circle", order: 2,
      });
    });
    const noise = all.map((p) => p[noiseMetric]).filter((s) => s > 0).sort((a, b) => a - b);
    if (noise.length > 0 && all.length > 0) {
      const y = noise[Math.floor(noise.length / 2)];
      const xs = all.map((p) => p.x);
      datasets.push({
        label: noiseTitle, showLine: true, pointRadius: 0, borderDash: [2, 3], borderWidth: 1,
        data: [Math.min(...xs), Math.max(...xs)].map((x) => ({ x, y, name: noiseTitle })),
        borderColor: colour("--soft"), backgroundColor: "transparent", order: 3,
      });
    }
    return {
      type: "scatter",
      data: { datasets },
      plugins: [pointNames],
      options: {
        scales: {
          x: logAxis(costTitle, all.map((p) => p.x)),
          y: logAxis(errorTitle, [...all.map((p) => p.y), ...noise]),
        },
        plugins: {
          legend: { position: "bottom", labels: { usePointStyle: true, boxHeight: 7 } },
          tooltip: {
            callbacks: {
              label: ({ raw }) =>
                `${raw.name}: ${tip.replace("{error}", short(raw.y)).replace("{cost}", short(raw.x))}`,
            },
          },
        },
      },
    };
  };

  // Figures of cases that begin with a prefix, over the number behind it.
  const curveChart = (canvas) => {
    const { table, prefix, unit } = canvas.dataset;
    const datasets = canvas.dataset.metrics.split(" ").map((metric, i) => ({
      label: metric,
      data: records
        .filter((r) => r.table === table && r.metric === metric && r.case.startsWith(prefix) && r.median !== null)
        .map((r) => ({ x: Number(r.case.slice(prefix.length)), y: r.median }))
        .filter((p) => Number.isFinite(p.x))
        .sort((a, b) => a.x - b.x),
      borderColor: palette[i % palette.length],
      backgroundColor: palette[i % palette.length],
      pointRadius: 4,
    }));
    const knob = prefix.slice(0, -1).split("/");
    return {
      type: "line",
      data: { datasets },
      options: {
        scales: {
          x: { type: "linear", title: { display: true, text: knob[knob.length - 1] } },
          y: { beginAtZero: true, title: { display: unit !== "", text: unit } },
        },
        plugins: {
          title: { display: true, text: canvas.getAttribute("aria-label"), color: colour("--ink") },
          legend: { display: datasets.length > 1, position: "bottom", labels: { usePointStyle: true, boxHeight: 7 } },
        },
      },
    };
  };

  // A bar for each run, the shortest on top.
  const runsChart = (canvas) => {
    const values = canvas.dataset.values.split(";").map(Number);
    const bars = canvas.dataset.labels.split(";").map((label, i) => ({ label, value: values[i] }));
    bars.sort((a, b) => a.value - b.value);
    return {
      type: "bar",
      data: {
        labels: bars.map((bar) => bar.label),
        datasets: [{ data: bars.map((bar) => bar.value), backgroundColor: palette[0], maxBarThickness: 22 }],
      },
      options: {
        indexAxis: "y",
        scales: { x: { ...logAxis(canvas.dataset.title, values), min: Math.min(...values) / 3 } },
        plugins: { legend: { display: false } },
      },
    };
  };

  // A click on a column's name sorts its table by the cells' keys, the other way the next time.
  const makeSortable = (table) => {
    table.querySelectorAll("thead th").forEach((head, column) => {
      const button = document.createElement("button");
      button.innerHTML = head.innerHTML;
      head.replaceChildren(button);
      button.addEventListener("click", () => {
        const down = head.getAttribute("aria-sort") === "ascending";
        table.querySelectorAll("thead th").forEach((other) => other.removeAttribute("aria-sort"));
        head.setAttribute("aria-sort", down ? "descending" : "ascending");
        const key = (row) => row.cells[column].dataset.key ?? row.cells[column].textContent;
        const compare = (a, b) => {
          if (key(a) === "" || key(b) === "") return (key(a) === "") - (key(b) === "");
          const by = Number(key(a)) - Number(key(b));
          return (down ? -1 : 1) * (Number.isNaN(by) ? key(a).localeCompare(key(b)) : by);
        };
        table.tBodies[0].append(...[...table.tBodies[0].rows].sort(compare));
      });
    });
  };

  const makers = { tradeoff: tradeOffChart, curve: curveChart, runs: runsChart };
  const draw = () => {
    charts.splice(0).forEach((chart) => chart.destroy());
    setTheme();
    document.querySelectorAll("canvas[data-chart]").forEach((canvas) => {
      charts.push(new Chart(canvas, makers[canvas.dataset.chart](canvas)));
    });
  };

  // A strip of equally wide pictures below their names: any two of them on one canvas, parted where
  // the range stands.
  const makeComparable = (figure) => {
    const image = figure.querySelector("img");
    const names = figure.dataset.panels.split(";");
    const width = image ? image.naturalWidth / names.length : 0;
    const nameHeight_px = Number(figure.dataset.nameHeight);
    const height = image ? image.naturalHeight - nameHeight_px : 0;
    if (names.length < 2 || width < 1 || width !== Math.floor(width) || height < 1) return;
    const canvas = document.createElement("canvas");
    canvas.width = width;
    canvas.height = height;
    canvas.setAttribute("role", "img");
    const choice = (chosen, label) => {
      const select = document.createElement("select");
      select.setAttribute("aria-label", label);
      names.forEach((name, i) => select.add(new Option(name, i, i === chosen, i === chosen)));
      return select;
    };
    const left = choice(0, "left picture");
    const truth = names.indexOf("truth");
    const right = choice(truth > 0 ? truth : 1, "right picture");
    const range = document.createElement("input");
    range.type = "range";
    range.max = 100;
    range.value = 50;
    range.setAttribute("aria-label", "where the left picture ends");
    const show = () => {
      const context = canvas.getContext("2d");
      const edge = Math.round((width * range.value) / 100);
      const part = (panel, from, to) => {
        if (to > from)
          context.drawImage(image, panel * width + from, nameHeight_px, to - from, height, from, 0, to - from, height);
      };
      part(Number(left.value), 0, edge);
      part(Number(right.value), edge, width);
      context.fillStyle = "#fff";
      context.fillRect(edge - 0.5, 0, 1, height);
      canvas.setAttribute("aria-label", `${names[left.value]} left, ${names[right.value]} right, ${range.value} percent`);
    };
    [left, right, range].forEach((control) => control.addEventListener("input", show));
    canvas.addEventListener("pointermove", (event) => {
      if (event.pointerType === "mouse" || event.buttons) {
        range.value = (100 * event.offsetX) / canvas.clientWidth;
        show();
      }
    });
    const slider = document.createElement("div");
    slider.className = "slider";
    slider.append(left, range, right);
    image.after(canvas, slider);
    figure.classList.add("live");
    show();
  };

  const isDrawn = (canvas) => {
    const { width, height } = canvas;
    if (width === 0 || height === 0) return false;
    const pixels = canvas.getContext("2d").getImageData(0, 0, width, height).data;
    for (let i = 3; i < pixels.length; i += 4) if (pixels[i] !== 0) return true;
    return false;
  };

  const check = () => {
    root.dataset.errors = errors.length;
    root.dataset.charts = charts.length;
    root.dataset.drawn = charts.filter((chart) => isDrawn(chart.canvas)).length;
    root.dataset.sliders = document.querySelectorAll(".slider input").length;
    root.dataset.overflow = Math.max(0, root.scrollWidth - root.clientWidth);
    root.dataset.background = getComputedStyle(document.body).backgroundColor;
  };

  draw();
  document.querySelectorAll(".sortable table").forEach(makeSortable);
  const figures = [...document.querySelectorAll("figure[data-panels]")];
  Promise.all(figures.map(async (figure) => {
    const image = figure.querySelector("img");
    if (image && !image.complete) await new Promise((done) => { image.onload = image.onerror = done; });
    makeComparable(figure);
  })).then(check);
  window.matchMedia("(prefers-color-scheme: dark)").addEventListener("change", draw);
  const drawForPaper = (printing) => {
    root.classList.toggle("printing", printing);
    draw();
  };
  window.addEventListener("beforeprint", () => drawForPaper(true));
  window.addEventListener("afterprint", () => drawForPaper(false));
})();
