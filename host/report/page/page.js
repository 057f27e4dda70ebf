// Draws the charts of the page from the records in it. Tables and pictures need no script.
"use strict";
(() => {
  const records = JSON.parse(document.getElementById("records").textContent);
  const style = getComputedStyle(document.documentElement);
  const colour = (name) => style.getPropertyValue(name).trim();
  const palette = ["#0b6e75", "#d1792b", "#6a51a3", "#2c7fb8", "#b3446c", "#7a8b2c", "#555f69"];
  Chart.defaults.color = colour("--soft");
  Chart.defaults.borderColor = colour("--line");
  Chart.defaults.animation = false;
  Chart.defaults.maintainAspectRatio = false;

  const value = (table, name, metric) => {
    const found = records.find((r) => r.table === table && r.case === name && r.metric === metric);
    return found ? found.median : null;
  };
  const unique = (list) => [...new Set(list)];

  // Where a frame's time goes, one bar per view.
  const drawBreakdown = (canvas) => {
    const table = canvas.dataset.table;
    const parts = ["raster_ms", "upload_ms", "frame_without_ms", "shading_ms", "readback_ms"];
    const names = ["rasterizing", "upload", "smooth lobes", "glints", "readback"];
    const cases = unique(records.filter((r) => r.table === table).map((r) => r.case));
    new Chart(canvas, {
      type: "bar",
      data: {
        labels: cases,
        datasets: parts.map((part, i) => ({
          label: names[i],
          data: cases.map((name) => value(table, name, part)),
          backgroundColor: palette[i],
        })),
      },
      options: {
        indexAxis: "y",
        scales: { x: { stacked: true, title: { display: true, text: "ms" } }, y: { stacked: true } },
      },
    });
  };

  document.querySelectorAll("canvas[data-chart=breakdown]").forEach(drawBreakdown);
})();
