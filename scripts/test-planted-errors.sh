#!/bin/bash
# Errors in the planner's model, one after the other: each is planted in a copy of this checkout, the
# program is built, and a maneuver that the error touches is solved. The plan is then wrong in a way
# that the planner cannot see, and `righting solve` must end with exit code 4: found, but failed its
# verification. Without an error the same maneuvers must end with 0.
#
# A place to plant that is not found exactly once fails the test: the model has moved on, and this file
# must follow. Builds seven times, 11 minutes of one core; PLANTED_TARGET names a folder that keeps what
# was built.
# Usage: scripts/test-planted-errors.sh
set -euo pipefail
root=$(cd "$(dirname "$0")/.." && pwd)

work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
trap 'exit 1' INT TERM
copy=$work/checkout
model=crates/multibody/src
export CARGO_TARGET_DIR=${PLANTED_TARGET:-$work/target}
program=$CARGO_TARGET_DIR/release/righting
failed=0

fail() {
    echo "test-planted: $*" >&2
    exit 1
}

copy_checkout() {
    mkdir "$copy"
    (cd "$root" && git ls-files -z --cached --others --exclude-standard) |
        (cd "$root" && tar --null --ignore-failed-read -cf - -T - 2> /dev/null) | tar -xf - -C "$copy"
}

# plant FILE OLD NEW: replaces the one place in $model/FILE where OLD stands.
plant() {
    local file=$copy/$model/$1 text rest
    text=$(< "$file")
    rest=${text#*"$2"}
    [ "$rest" != "$text" ] || fail "$model/$1: expected this once, found it nowhere: $2"
    [ "${rest#*"$2"}" = "$rest" ] || fail "$model/$1: expected this once, found it more often: $2"
    printf '%s\n' "${text%%"$2"*}$3$rest" > "$file"
}

# Takes every planted error out again.
restore() {
    local file
    for file in "$root/$model"/*.rs; do
        cmp -s "$file" "$copy/$model/${file##*/}" || cp "$file" "$copy/$model/"
    done
}

build() {
    (cd "$copy" && cargo build --release --locked --quiet) || fail "$1: does not build"
}

# solve NAME CODE SCENARIO [CHECK...]: the exit code, and checks that must be among those that failed.
solve() {
    local name=$1 code=$2 scenario=$3 found=0 out=$work/out checks check verdict=ok
    shift 3
    rm -rf "$out"
    (cd "$copy" && "$program" solve "scenarios/$scenario.json" --out "$out" --figures none --no-report) \
        > "$work/stdout" 2> "$work/stderr" || found=$?
    checks=$("$program" verify "$out" 2> /dev/null | sed -n 's/^  FAILED  //p' | sed 's/  .*//' |
        paste -sd, | sed 's/,/, /g') || true
    [ "$found" = "$code" ] || verdict="WRONG: expected exit code $code, found $found"
    for check; do
        case ", $checks, " in
            *", $check, "*) ;;
            *) verdict="WRONG: the check '$check' did not fail" ;;
        esac
    done
    echo "$name | $scenario | exit $found | ${checks:--} | $verdict"
    [ "$verdict" = ok ] || { failed=1; tail -n 5 "$work/stderr" >&2; }
}

copy_checkout
echo "planted | scenario | solve | checks that failed | verdict"

build "without an error"
for scenario in slew_4dof slew_4dof_full detumble_canadarm2 detumble_4dof_full; do
    solve "nothing" 0 $scenario
done

name="sign of H~"
plant composite.rs \
    'relative: relative.shifted(&root.across),' \
    'relative: {
                let Pair { linear, angular } = relative.shifted(&root.across);
                Pair { linear, angular: angular.map(|entry| -entry) }
            },'
build "$name"
solve "$name" 4 slew_4dof "attitude mismatch" "angular momentum drift"
solve "$name" 4 detumble_canadarm2 "attitude mismatch" "angular momentum drift"
restore

name="swapped axis in one inertia"
plant chain.rs \
    'chain.joints.push(Joint::new(angle, row.body, row.offset, row.twist));' \
    'let mut body = row.body;
                    if k == 2 {
                        body.second.swap_rows(0, 2);
                        body.second.swap_columns(0, 2);
                    }
                    chain.joints.push(Joint::new(angle, body, row.offset, row.twist));'
build "$name"
solve "$name" 4 slew_4dof "attitude mismatch" "angular momentum drift" "joint torque mismatch"
restore

name="dropped Coriolis term"
plant dynamics.rs \
    'Vector3::new(a.x + w.y * rate, a.y - w.x * rate, a.z + acceleration)' \
    'Vector3::new(a.x, a.y, a.z + acceleration)'
build "$name"
solve "$name" 4 slew_4dof "joint torque mismatch"
solve "$name" 4 slew_4dof_full "attitude mismatch" "angular momentum drift"
solve "$name" 4 detumble_canadarm2 "joint torque mismatch"
restore

name="dropped gyroscopic moment"
plant dynamics.rs \
    'sum(&constant_matrix_product(inertia, &self.acceleration), &steady)' \
    'sum(&constant_matrix_product(inertia, &self.acceleration), &(steady - steady))'
build "$name"
solve "$name" 4 detumble_canadarm2 "joint torque mismatch"
restore

name="sign in the attitude's rate"
plant attitude.rs \
    'vector: sum(&scaled(&half, self.w), &cross(&self.vector, &half)),' \
    'vector: difference(&scaled(&half, self.w), &cross(&self.vector, &half)),'
build "$name"
solve "$name" 4 slew_4dof "attitude mismatch"
solve "$name" 4 detumble_4dof_full "attitude mismatch"
restore

name="base elsewhere for clearances"
plant clearance.rs \
    'let origin = -(to_root * chain.root_position);' \
    'let origin = -(to_root * chain.root_position) * 1.5;'
build "$name"
solve "$name" 4 detumble_canadarm2 "clearance from body at nodes"

[ "$failed" = 0 ] || fail "an error was not caught as it should be"
echo "every planted error was caught"
