// The table of runs: sorted by any column, filtered by words, with the columns one chooses.

const numberPattern = /^[+-]?(\d+\.?\d*|\.\d+)([eE][+-]?\d+)?$/;
const infinities = {inf: Infinity, "+inf": Infinity, "-inf": -Infinity};

// The cell as a number; null where it is empty or nan, undefined where it is text.
function cellNumber(cell) {
  const text = cell.trim();
  if (text === "" || /^[+-]?nan$/i.test(text)) return null;
  if (numberPattern.test(text)) return Number(text);
  return infinities[text.toLowerCase()];
}

function columnOf(name, index, rows) {
  const numbers = rows.map(row => cellNumber(row[index]));
  const isNumeric = numbers.some(x => x !== null) && !numbers.includes(undefined);
  const values = numbers.filter(x => x !== null);
  const isWhole = isNumeric && values.every(x => Number.isInteger(x) && Math.abs(x) < 1e9);
  return {name, index, isNumeric, isWhole, numbers, varies: new Set(rows.map(row => row[index])).size > 1};
}

// To four digits, for reading; the whole number is in the tooltip.
function shortNumber(cell, isWhole) {
  const x = cellNumber(cell);
  if (x === null || !Number.isFinite(x) || isWhole) return cell;
  if (x !== 0 && (Math.abs(x) >= 1e5 || Math.abs(x) < 1e-3))
    return x.toExponential(3).replace(/\.?0+e/, "e").replace("+", "").replaceAll("-", "−");
  return String(+x.toPrecision(4)).replace("-", "−");
}

// Of the columns the first shown: what a run was and what came of it.
const resultColumns = ["breakage.class", "breakage.chipping_ratio", "fragments.by_damage_label.largest_mass_fraction",
                       "fragments.largest_mass_fraction", "fragments.by_damage_label.count_above_0p1pct", "breakage.t10",
                       "rebound.restitution_normal", "energy.kinetic", "energy.cohesive_dissipated", "tools.wall.max_force",
                       "energy.closure_error"];
function startColumns(columns, asked) {
  const named = name => columns.find(column => column.name === name);
  if (asked.length) return new Set(asked.map(named).filter(Boolean));
  // In results.csv what varies comes after run, state and reason, before the first key of the report.
  const reportBegins = columns.findIndex(column => column.name === "stop_reason");
  const keys = columns.slice(3, Math.max(reportBegins, 3)).filter(column => column.varies);
  const chosen = new Set([columns[0], named("state"), ...keys, ...resultColumns.map(named)].filter(Boolean));
  return chosen.size > 2 ? chosen : new Set(columns.slice(0, 16));
}

const element = (tag, attributes = {}, ...children) => {
  const made = Object.assign(document.createElement(tag), attributes);
  made.append(...children);
  return made;
};

// The text with places for line breaks after _ and . .
const breakable = text => text.split(/(?<=[_.])/).flatMap((part, i) => i ? [element("wbr"), part] : [part]);

function csvText(columns, rows) {
  const quoted = text => /[",\n\r#]/.test(text) ? `"${text.replaceAll('"', '""')}"` : text;
  return [columns.map(column => quoted(column.name)), ...rows.map(row => columns.map(column => quoted(row[column.index])))]
      .map(cells => cells.join(",") + "\r\n").join("");
}

// `framed`: names of the runs to be seen in 3-D; `choose(name)` shows one.
function makeRunsTable(table, data, framed, choose) {
  const columns = data.columns.map((name, index) => columnOf(name, index, data.rows));
  let visible = startColumns(columns, data.shown);
  const order = {column: null, descending: false};
  let words = [], shownName = null;

  const shownColumns = () => [...visible];

  // Sorted with empty cells last, equal ones in the order of the file.
  function sorted(rows) {
    if (!order.column) return rows;
    const {index, isNumeric, numbers} = order.column, sign = order.descending ? -1 : 1;
    const key = i => isNumeric ? numbers[i] : data.rows[i][index] || null;
    return rows.sort((i, j) => {
      const a = key(i), b = key(j);
      if (a === null || b === null) return (a === null) - (b === null) || i - j;
      const less = isNumeric ? (a > b) - (a < b) : a.localeCompare(b, "en", {numeric: true});
      return sign * less || i - j;
    });
  }
  function shownRows() {
    const searched = shownColumns();
    const fits = row => {
      const text = searched.map(column => row[column.index]).join("\t").toLowerCase();
      return words.every(word => text.includes(word));
    };
    return sorted(data.rows.map((row, i) => i).filter(i => fits(data.rows[i])));
  }

  function headCell(column) {
    const [, path, unit] = column.name.match(/^(.*?)(\s*\[[^\]]*\])?$/s) || [0, column.name, ""];
    const last = path.lastIndexOf(".") + 1;
    const th = element("th", {scope: "col", title: column.name, className: column.isNumeric ? "number" : ""});
    const button = element("button", {type: "button"});
    if (last) button.append(element("small", {}, ...breakable(path.slice(0, last - 1))));
    const mark = element("span", {className: "order"});
    mark.setAttribute("aria-hidden", "true");
    button.append(element("span", {}, ...breakable(path.slice(last)), unit ? " " + unit.trim() : "", " ", mark));
    const isSorted = order.column === column;
    th.setAttribute("aria-sort", isSorted ? (order.descending ? "descending" : "ascending") : "none");
    button.addEventListener("click", () => {
      order.descending = order.column === column && !order.descending;
      order.column = column;
      draw();
      [...table.tHead.querySelectorAll("th")].find(cell => cell.title === column.name)?.querySelector("button").focus();
    });
    th.append(button);
    th.dataset.column = column.index;
    return th;
  }

  // Long names are cut at their beginning: the values that vary most are at the end.
  function nameCell(name) {
    const text = element("bdi", {dir: "ltr"}, name);
    const shown = framed.has(name) ? element("button", {type: "button", className: "name to-view"}, text)
                                   : element("span", {className: "name"}, text);
    if (framed.has(name)) shown.setAttribute("aria-label", `Show ${name} in 3-D`);
    return element("th", {scope: "row", title: name}, shown);
  }
  function bodyRow(i, drawn) {
    const row = data.rows[i], tr = element("tr");
    tr.dataset.row = i;
    for (const column of drawn) {
      const cell = row[column.index];
      if (column.index === 0) tr.append(nameCell(cell));
      else tr.append(element("td", {className: column.isNumeric ? "number" : "text", title: cell},
                             column.isNumeric ? shortNumber(cell, column.isWhole) : cell));
    }
    if (framed.has(row[0])) tr.classList.add("has-frame");
    tr.classList.toggle("shown", row[0] === shownName);
    return tr;
  }

  function draw() {
    const drawn = shownColumns(), rows = shownRows();
    table.tHead.replaceChildren(element("tr", {}, ...drawn.map(headCell)));
    const lines = rows.map(i => bodyRow(i, drawn));
    const nothing = element("td", {className: "empty", colSpan: drawn.length || 1}, "No run fits the filter.");
    if (!rows.length) lines.push(element("tr", {}, nothing));
    table.tBodies[0].replaceChildren(...lines);
    const count = document.getElementById("row-count");
    const all = data.rows.length;
    count.textContent = rows.length === all ? `${all} runs` : `${rows.length} of ${all} runs`;
  }

  table.tBodies[0].addEventListener("click", event => {
    const row = event.target.closest("tr")?.dataset.row;
    if (row === undefined || String(getSelection())) return;
    if (framed.has(data.rows[row][0])) choose(data.rows[row][0]);
  });
  draw();
  return {
    columns,
    isVisible: column => visible.has(column),
    setVisible(column, isOn) {
      isOn ? visible.add(column) : visible.delete(column);
      draw();
    },
    showAll() { visible = new Set(columns); draw(); },
    showDefault() { visible = startColumns(columns, data.shown); draw(); },
    filter(text) { words = text.toLowerCase().split(/\s+/).filter(Boolean); draw(); },
    mark(name) {
      shownName = name;
      for (const tr of table.tBodies[0].rows) tr.classList.toggle("shown", data.rows[tr.dataset.row]?.[0] === name);
    },
    csv: () => csvText(shownColumns(), shownRows().map(i => data.rows[i]))
  };
}
