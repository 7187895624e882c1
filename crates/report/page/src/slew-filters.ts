import type { SlewsData } from "./slew-data";

/** More settings than these are no choice. */
const MOST_CHOICES = 60;

/** A choice a column that varies beside axis and angle. */
export class SlewFilters {
  private readonly chosen = new Map<number, string>();
  private readonly selects = new Map<number, HTMLSelectElement>();

  /** `apply` gets what is shown, by the index of a point, whenever that changes. */
  constructor(
    container: HTMLElement, private readonly data: SlewsData,
    private readonly apply: (isShown: (index: number) => boolean) => void,
  ) {
    data.columns.forEach((name, column) => {
      const settings = [...new Set(data.points.map((point) => point.settings[column]))];
      if (settings.length < 2 || settings.length > MOST_CHOICES) return;
      const select = document.createElement("select");
      select.setAttribute("aria-label", name);
      select.add(new Option(`${name}: all`, ""));
      for (const setting of settings) select.add(new Option(`${name}: ${setting}`, setting));
      select.addEventListener("change", () => this.choose(column, select.value));
      this.selects.set(column, select);
      container.append(select);
    });
    container.hidden = this.selects.size === 0;
  }

  /** Shows only the slews with a setting of a column; all again with "". */
  choose(column: number, setting: string): void {
    const select = this.selects.get(column);
    if (select) select.value = setting;
    if (setting === "") this.chosen.delete(column);
    else this.chosen.set(column, setting);
    const { points } = this.data;
    this.apply((index) => [...this.chosen].every(([at, wanted]) => points[index].settings[at] === wanted));
  }
}
