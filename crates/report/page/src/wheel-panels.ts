import type { ReportData } from "./data";
import { short } from "./format";
import type { Motion } from "./motion";
import { common, type Panel } from "./panel";
import { jointColor } from "./theme";

/** What the wheels that work store and give; nothing without such wheels. */
export function wheelPanels({ wheels }: ReportData, motion: Motion): Panel[] {
  const working = wheels.flatMap((wheel, i) => (wheel.failed ? [] : [{ wheel, i }]));
  if (working.length === 0) return [];
  const panel = (
    title: string, unit: string, column: "wheel_momenta_n_m_s" | "wheel_torques_n_m", most: number[], held: boolean,
  ): Panel => {
    const distinct = [...new Set(most)].sort((a, b) => a - b);
    return {
      title, unit, held, leastSpan: 1e-6,
      curves: working.map(({ i }) => ({
        name: `wheel ${i + 1}`, stroke: () => jointColor(i), values: motion.component(column, i),
      })),
      limits: {
        text: `limit ±${distinct.map((limit) => short(limit, 3)).join(", ±")}`,
        lines: distinct.flatMap((limit) => [common(-limit), common(limit)]),
      },
    };
  };
  return [
    panel("Momenta of the wheels", "N m s", "wheel_momenta_n_m_s",
      working.map(({ wheel }) => wheel.momentum_max_n_m_s), false),
    panel("Torques of the wheels", "N m", "wheel_torques_n_m",
      working.map(({ wheel }) => wheel.torque_max_n_m), true),
  ];
}
