# Every target works on a fresh clone: what the build needs is installed first where that is allowed.
.PHONY: references fuzz faults leaks deny sbom vendored demo paper test test-debian13 test-planted test-slurm cases check-import random replay limits wheels wheel flights deb book bench bench-all starts page fmt lint setup

DEMO := out/demo

demo: setup
	cargo build --release --locked
	cargo run --release --locked --quiet -- solve scenarios/slew_4dof.json --out $(DEMO)

# The random tests draw the same inputs everywhere; PROPTEST_RNG_SEED=7 make test draws others.
test: export PROPTEST_RNG_SEED ?= 20261130
test:
	@scripts/setup.sh test
	cargo test --workspace --locked
	# The bindings again, linked to Ipopt instead of opening it.
	cargo test -p righting-ipopt-sys --no-default-features --locked

# Starts Slurm's daemons, so not part of `test`: as root, with Debian's slurmctld and slurmd.
test-slurm: setup
	cargo build --release --locked
	scripts/test-slurm.sh

# Errors planted in the planner's model, each caught by the verifier's: 11 minutes of one core.
test-planted: setup
	scripts/test-planted-errors.sh

# Public arms and bug reports, each with what is right: under a minute.
cases: setup
	cargo build --release --locked
	scripts/cases.py --righting "$${CARGO_TARGET_DIR:-target}/release/righting"

# 300 maneuvers of random arms, outcomes by cause and times, then every verified plan against Pinocchio, which
# gets a virtual environment of its own.
random: setup
	cargo build --release --locked
	scripts/random_maneuvers.py --righting "$${CARGO_TARGET_DIR:-target}/release/righting"
	scripts/pinocchio.sh out/random

# The paper's plans flown in MuJoCo and Basilisk by their exported files alone, and every export read by the
# program that it is for: docs/replay.md. Gets a virtual environment of its own.
replay: setup
	cargo build --release --locked
	cargo build --release --locked -p righting-export --example reference
	target="$${CARGO_TARGET_DIR:-target}/release" && \
		scripts/replay.sh --righting "$$target/righting" --reference "$$target/examples/reference"

# What each limit costs, on three arms, every plan judged by Pinocchio: docs/limits.md. Gets a virtual environment
# of its own.
limits: setup
	cargo build --release --locked
	scripts/limits.sh --righting "$${CARGO_TARGET_DIR:-target}/release/righting"

# The Debian package of this release of Debian, in out/deb; `make deb TRY=--try` also installs it in a clean root.
deb: setup
	cargo build --release --locked
	scripts/deb.sh $(TRY)

# 1,000 flights each of slews and a detumble with spacecraft that are not as planned, and MuJoCo as the spacecraft:
# docs/flown.md. Gets a virtual environment of its own; a quarter of an hour.
flights: setup
	cargo build --release --locked
	scripts/flights.sh --righting "$${CARGO_TARGET_DIR:-target}/release/righting"

# What arm and wheels do alone and together, every plan replayed by Pinocchio: docs/wheels.md. Gets a virtual
# environment of its own.
wheels: setup
	cargo build --release --locked
	scripts/wheels.sh --righting "$${CARGO_TARGET_DIR:-target}/release/righting"

# The wheel of the Python package in out/wheel/dist, with Ipopt in it, and its tests in a virtual environment of its
# own, beside the plans of the command line.
wheel: setup
	cargo build --release --locked
	scripts/wheel.sh --righting "$${CARGO_TARGET_DIR:-target}/release/righting"

# The book in out/book/html: tutorial, guides, theory, references made from the program, all documents. Loads nothing.
book: setup
	cargo build --release --locked
	scripts/book.sh --righting "$${CARGO_TARGET_DIR:-target}/release/righting"

# Public and random robots, imported and exported again, beside Pinocchio's and MuJoCo's models of them:
# docs/import.md. Gets a virtual environment of its own.
check-import: setup
	cargo build --release --locked
	cargo build --release --locked -p righting-export --example reference
	target="$${CARGO_TARGET_DIR:-target}/release" && \
		scripts/check_import.sh --righting "$$target/righting" --reference "$$target/examples/reference"

# All tests on Debian 13, in a root of its own: as root, with debootstrap.
test-debian13:
	scripts/test-debian13.sh

# The paper's figures and tables, with its numbers beside ours: docs/paper.md.
paper: setup
	cargo build --release --locked
	cargo run --release --locked --quiet -- figures --out out/paper
	cargo run --release --locked --quiet -- sweep scenarios/sweeps/reach_2dof.json --resume --out out/paper/fig6_reach

# References that scripts of other groups' libraries make, made again: docs/reliability.md. Gets a virtual environment
# of its own.
references:
	scripts/in-environment.sh out/pinocchio "pin numpy" scripts/reference_dynamics.py

# Hostile inputs of a fixed seed, 130,000 for each of eight readers and 2,000 whole solves; each target says its counts.
# FUZZ_SEED=7 make fuzz takes others.
FUZZ_SEED ?= 1
fuzz: setup
	cargo build --release --locked -p righting-fuzz
	fuzz="$${CARGO_TARGET_DIR:-target}/release/righting-fuzz" && \
		$$fuzz scenario system wheels sweep urdf trajectory journal --seed $(FUZZ_SEED) --inputs 130000 && \
		$$fuzz solution --seed $(FUZZ_SEED) --inputs 130000 && \
		$$fuzz solve --seed $(FUZZ_SEED) --inputs 2000

# `solve` killed at every call by which it touches its folder; needs strace.
faults: setup
	cargo build --release --locked
	scripts/kill_at_every_call.py --righting "$${CARGO_TARGET_DIR:-target}/release/righting"

# A thousand solves in one process: memory that grows, and with valgrind what nobody frees.
leaks: setup
	cargo build --release --locked -p righting-planner --example many_solves
	solves="$${CARGO_TARGET_DIR:-target}/release/examples/many_solves" && $$solves 1000 && \
		valgrind --leak-check=full --show-leak-kinds=definite --errors-for-leak-kinds=definite \
		--error-exitcode=1 $$solves 1000

# Licences, sources and duplicates by cargo-deny; the advisories need the network.
deny:
	cargo deny --all-features check licenses bans sources

# The bill of materials of the program, CycloneDX.
sbom:
	@mkdir -p out
	scripts/sbom.py > out/righting.cdx.json

# The program from a copy of all that it is built from, without the network.
vendored: setup
	scripts/vendored-build.sh out/vendored

bench:
	scripts/bench.sh

bench-all:
	scripts/bench.sh --all

# The bundle of the interactive page, from its sources; needs Node, which the build does not.
page:
	cd crates/report/page && npm ci --silent && npm run --silent check && npm run --silent build

# Five minutes on two cores: what the automatic guess is worth, as docs/starts.md.
starts: setup
	cargo build --release --locked
	scripts/starts.py --righting "$${CARGO_TARGET_DIR:-target}/release/righting"

fmt:
	cargo fmt --all

lint: setup
	cargo fmt --all --check
	cargo clippy --workspace --all-targets --locked -- -D warnings
	# The Python package is a workspace of its own: that it follows the crates is seen here.
	cargo fmt --manifest-path python/Cargo.toml --check
	cargo clippy --manifest-path python/Cargo.toml --locked -- -D warnings
	RUSTDOCFLAGS="-D warnings" cargo doc --workspace --no-deps --locked

setup:
	@scripts/setup.sh
