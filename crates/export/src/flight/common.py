# How fast a tracked joint returns, 1/s.
RETURN = 10.0


def planned(step, time_s):
    """Angles and rates of the joints in a step of the plan."""
    rates = RATES[step] + time_s * (ACCELERATIONS[step] + time_s * JERKS[step] / 2)
    accelerations = ACCELERATIONS[step] + time_s * JERKS[step] / 3
    return ANGLES[step] + time_s * (RATES[step] + time_s * accelerations / 2), rates


def percent(torques):
    """The largest of these torques in percent of its joint's peak, where that is one."""
    peaks = np.abs(TORQUES).max(axis=0)
    counts = peaks > 1e-6 * peaks.max(initial=0.0)
    return float((100 * np.abs(torques[counts]) / peaks[counts]).max(initial=0.0))


def angle_between(a, b):
    a, b = (np.asarray(q) / np.linalg.norm(q) for q in (a, b))
    return float(4 * np.arcsin(min(np.linalg.norm(a - b), np.linalg.norm(a + b)) / 2))


def main():
    parser = argparse.ArgumentParser(description=f"Fly {NAME} ({MANEUVER}) in {SIMULATOR} by its torques alone.")
    parser.add_argument("--step", type=float, default=0.005, help=f"the largest step of {SIMULATOR}, s; 0.005 by default")
    parser.add_argument("--track", action="store_true", help="hold the joints to the plan")
    parser.add_argument("--json", action="store_true", help="print one JSON object")
    arguments = parser.parse_args()
    outcome = fly(arguments.step, arguments.track)
    if arguments.json:
        print(json.dumps(outcome))
        return
    print(f"{NAME}: {MANEUVER}")
    print(f"{outcome['simulator']}, {outcome['integrator']}, steps of {1000 * outcome['step_s']:.3g} ms")
    print(f"attitude error at the end: {outcome['attitude_error_rad']:.1e} rad")
    print(f"joint error at the end:    {outcome['joint_error_rad']:.1e} {JOINT_UNIT}")
    print(f"peak torque difference:    {outcome['peak_torque_difference_percent']:.1e} %")
    if arguments.track:
        print(f"torque for tracking:       {outcome['tracking_torque_percent']:.1e} %")


if __name__ == "__main__":
    main()
