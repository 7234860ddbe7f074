// Joins the parts of the page.

const byId = id => document.getElementById(id);
const stored = id => JSON.parse(byId(id).textContent);

function save(name, url) {
  const link = element("a", {href: url, download: name});
  document.body.append(link);
  link.click();
  link.remove();
}

function fillLegend(list, fragments) {
  const most = 10, large = fragments.filter(f => !f.isFine), fines = fragments.filter(f => f.isFine);
  const sum = some => some.reduce((total, f) => total + f.share, 0);
  const line = (colour, text, share) => {
    const swatch = element("i");
    if (colour) swatch.style.background = `rgb(${colour})`;
    return element("li", {}, swatch, element("span", {}, text), element("span", {}, percent(share)));
  };
  const lines = large.slice(0, most).map(f => line(palette[f.rank % palette.length], `Fragment ${f.rank + 1}`, f.share));
  if (large.length > most) lines.push(line(null, `${large.length - most} more`, sum(large.slice(most))));
  if (fines.length) lines.push(line(finesColour, `Fines, ${fines.length} below 0.1 %`, sum(fines)));
  list.replaceChildren(...lines);
}

// What all names begin with, up to a '-': a list of long ones need not show it.
function commonPrefix(names) {
  let prefix = names[0];
  for (const name of names) while (!name.startsWith(prefix)) prefix = prefix.slice(0, -1);
  return names.length > 1 ? prefix.slice(0, prefix.lastIndexOf("-") + 1) : "";
}

// Returns what shows a run by its name.
function setUpViewer(frames, shownRun) {
  if (!frames.length) return {show() {}};
  byId("fragments").hidden = false;
  const viewer = makeViewer(byId("view")), message = byId("view-message"), choice = byId("run-choice");
  if (!viewer) {
    message.textContent = "The 3-D view needs WebGL, which this browser does not have or has switched off.";
    byId("panel").inert = true;
    return {show() {}};
  }
  const prefix = commonPrefix(frames.map(frame => frame.name));
  const short = name => (prefix && "… ") + name.slice(prefix.length);
  choice.append(...frames.map((frame, i) => element("option", {value: i, title: frame.name}, frame.caption || short(frame.name))));
  let last = 0;
  async function show(index) {
    const turn = ++last, frame = frames[index];
    choice.value = index;
    byId("run-before").disabled = index === 0;
    byId("run-after").disabled = index === frames.length - 1;
    try {
      const {fragments, ring} = await viewer.show(frame, byId(`frame-${index}`).textContent);
      if (turn !== last) return;
      fillLegend(byId("legend"), fragments);
      message.textContent = "";
      byId("wall-switch").hidden = !ring;
      byId("view-caption").replaceChildren(element("strong", {}, frame.name), frame.caption);
      byId("view-scale").textContent = ring ? `Rings on the wall: every ${lengthText(ring)}` : "";
      byId("view").setAttribute("aria-label", `Fragments of ${frame.name}`);
      byId("view").dataset.shown = frame.name;
      shownRun(frame.name);
    } catch (error) {
      message.textContent = `The fragments cannot be shown: ${error.message}`;
    }
  }
  choice.addEventListener("change", () => show(Number(choice.value)));
  byId("run-before").addEventListener("click", () => show(Math.max(Number(choice.value) - 1, 0)));
  byId("run-after").addEventListener("click", () => show(Math.min(Number(choice.value) + 1, frames.length - 1)));
  let pointed = null;  // where the pointer is, until the next picture
  const tell = () => {
    const fragment = pointed && viewer.fragmentAt(...pointed);
    pointed = null;
    byId("view-pointed").textContent = fragment ? `Fragment ${fragment.rank + 1}: ${percent(fragment.share)}` : "";
  };
  byId("view").addEventListener("pointermove", event => {
    if (event.buttons) return;
    if (!pointed) requestAnimationFrame(tell);
    pointed = [event.offsetX, event.offsetY];
  });
  byId("view").addEventListener("pointerleave", () => { byId("view-pointed").textContent = ""; });
  const moveApart = () => {
    byId("apart-value").textContent = `${byId("apart").value} %`;
    viewer.set({apart: byId("apart").value / 100});
  };
  byId("apart").addEventListener("input", moveApart);
  for (const part of ["fines", "lines", "wall"])
    byId(`show-${part}`).addEventListener("change", event => viewer.set({[part]: event.target.checked}));
  byId("reset-view").addEventListener("click", () => {
    byId("apart").value = 0;
    moveApart();
    viewer.reset();
  });
  byId("save-view").addEventListener("click", () => save(`${frames[choice.value].name}.png`, viewer.picture(true)));
  show(0);
  return {viewer, show(name) {
    show(frames.findIndex(frame => frame.name === name));
    byId("fragments").scrollIntoView();
  }};
}

function fillColumnList(table) {
  const list = byId("column-list"), find = byId("column-filter");
  const draw = () => {
    const lines = [], word = find.value.toLowerCase();
    let group = null;
    for (const column of table.columns.filter(column => column.name.toLowerCase().includes(word))) {
      const own = column.name.includes(".") ? column.name.split(".")[0] : "";
      if (own !== group && own) lines.push(element("div", {className: "group"}, own));
      group = own;
      const box = element("input", {type: "checkbox", checked: table.isVisible(column)});
      box.addEventListener("change", () => table.setVisible(column, box.checked));
      lines.push(element("label", {}, box, own ? column.name.slice(own.length + 1) : column.name));
    }
    list.replaceChildren(...lines);
  };
  find.addEventListener("input", draw);
  byId("columns-all").addEventListener("click", () => { table.showAll(); draw(); });
  byId("columns-default").addEventListener("click", () => { table.showDefault(); draw(); });
  byId("columns").addEventListener("toggle", draw);
  document.addEventListener("click", event => { if (!event.target.closest("#columns")) byId("columns").open = false; });
  byId("columns").addEventListener("keydown", event => {
    if (event.key !== "Escape") return;
    byId("columns").open = false;
    byId("columns").querySelector("summary").focus();
  });
}

function setUpPictures() {
  const large = byId("large");
  for (const button of document.querySelectorAll(".enlarge"))
    button.addEventListener("click", () => {
      const picture = button.querySelector("img"), caption = button.closest("figure").querySelector("figcaption");
      large.querySelector("img").src = picture.src;
      large.querySelector("img").alt = picture.alt;
      large.querySelector("p").textContent = caption.firstElementChild.textContent || picture.alt;
      large.showModal();
    });
  large.addEventListener("click", event => { if (event.target.tagName !== "P") large.close(); });
  for (const link of document.querySelectorAll(".plot .save"))
    link.href = link.closest("figure").querySelector("img").src;
}

// Marks in the contents where one reads.
function setUpContents() {
  const links = [...document.querySelectorAll("#contents a")];
  for (const link of links) link.parentElement.hidden = !document.querySelector(link.getAttribute("href"));
  const mark = () => {
    const top = link => document.querySelector(link.getAttribute("href"))?.getBoundingClientRect().top;
    const passed = links.filter(link => top(link) < 120);
    for (const link of links) {
      if (link === passed.at(-1)) link.setAttribute("aria-current", "true");
      else link.removeAttribute("aria-current");
    }
  };
  addEventListener("scroll", mark, {passive: true});
  mark();
}

const knapPage = (() => {
  const frames = stored("frames");
  let table = null;
  const view = setUpViewer(frames, name => table?.mark(name));
  table = makeRunsTable(byId("runs-table"), stored("table"), new Set(view.viewer ? frames.map(frame => frame.name) : []),
                        name => view.show(name));
  byId("framed-hint").hidden = !view.viewer;
  fillColumnList(table);
  byId("filter").addEventListener("input", event => table.filter(event.target.value));
  byId("save-table").addEventListener("click", () => {
    const url = URL.createObjectURL(new Blob([table.csv()], {type: "text/csv"}));
    save("runs.csv", url);
    setTimeout(() => URL.revokeObjectURL(url), 10000);
  });
  setUpPictures();
  setUpContents();
  return {viewer: view.viewer, table};
})();
