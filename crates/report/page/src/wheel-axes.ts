import { Group, Quaternion, Vector3 } from "three";
import type { WheelData } from "./data";
import { label, polyline, segments } from "./parts";

const POLE = new Vector3(0, 0, 1);

/** The axes of the wheels in body axes, each with a rim at its end and its number; those that failed are faint. */
export function wheelAxes(wheels: WheelData[], length: number): Group {
  const group = new Group();
  wheels.forEach(({ axis, failed }, i) => {
    const direction = new Vector3(...axis);
    const end = direction.clone().multiplyScalar(length);
    const turn = new Quaternion().setFromUnitVectors(POLE, direction);
    const rim = Array.from({ length: 33 }, (_, k) => {
      const angle = (k / 16) * Math.PI;
      const spoke = new Vector3(0.1 * length * Math.cos(angle), 0.1 * length * Math.sin(angle), 0);
      return spoke.applyQuaternion(turn).add(end);
    });
    const stroke = { color: "momentum-wheels", width: 2, opacity: failed ? 0.3 : 0.9 };
    const name = label("w", `${i + 1}`, "momentum-wheels");
    name.position.copy(direction).multiplyScalar(1.12 * length);
    group.add(segments([new Vector3(), end], stroke), polyline(rim, stroke), name);
  });
  return group;
}
