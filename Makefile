# Two commands do everything on a fresh Debian 12 or Ubuntu 24.04: `make verify` and `make test`.
# Each installs what is missing, configures, builds and runs. CMake alone works too: see README.md.

BUILD   ?= build
RESULTS ?= results
PROGRAM  = $(BUILD)/verification/mpm-verify
# A reviewer signs paper: printed where a browser is there.
PDF     := $(if $(shell command -v chromium || command -v chromium-browser || command -v google-chrome),--pdf)

# Seconds that `make fuzz` gives each of its three harnesses.
FUZZ_SECONDS ?= 60
FUZZ_COUNT ?= 5000

.PHONY: verify verify-quick verify-deep verify-peers verify-slurm test bench fuzz fuzz-mutations fuzz-sanitized faults package program packages configure clean

verify: program
	$(PROGRAM) run --suite full --out $(RESULTS) $(PDF)

verify-quick: program
	$(PROGRAM) run --suite quick --out $(RESULTS)-quick

verify-deep: program
	$(PROGRAM) run --suite deep --out $(RESULTS)-deep

# Other people's solvers beside ours: OpenFOAM, installed if it is missing.
verify-peers: program
	sh verification/adapters/openfoam/install
	$(PROGRAM) run --suite peers --out $(RESULTS)-peers

# The quick suite through a real Slurm, one node in user space, with a task killed midway. Needs root or sudo.
verify-slurm: program
	tests/slurm/run-slurm $(PROGRAM) $(RESULTS)-slurm

test: configure
	cmake --build $(BUILD)
	ctest --test-dir $(BUILD) -L 'unit|e2e' --output-on-failure

bench: configure
	cmake --build $(BUILD) --target mpm-bench
	$(BUILD)/tests/mpm-bench $(RESULTS)-bench

fuzz: packages
	cmake --preset fuzz
	cmake --build build-fuzz --target fuzz-scene fuzz-study fuzz-csv
	sh tests/fuzz/run-fuzz build-fuzz/tests $(FUZZ_SECONDS)

# The same readers by mutations of what is shipped, in the build $(1): $(2) of them each, or $(2) = 20s as many as there is time for.
# Other inputs for every commit; what goes wrong is left in $(1)/fuzzed-input.
define mutate
	cmake --build $(1) --target fuzzed-scene fuzzed-study fuzzed-csv
	cd $(1) && export MPM_FUZZ_SEED=$$(git -C $(CURDIR) rev-list --count HEAD 2> /dev/null || echo 1); \
	toml="$(CURDIR)/verification/scenes/*.toml $(CURDIR)/tests/fuzz/corpus/*.toml"; \
	tests/fuzzed-scene $(2) $$toml && \
	tests/fuzzed-study $(2) $$toml $$(find $(CURDIR)/verification/studies -name '*.toml') && \
	tests/fuzzed-csv $(2) $(CURDIR)/tests/fuzz/corpus/*.csv
endef

# With the compiler that is there: a third of FUZZ_SECONDS each.
fuzz-mutations: configure
	$(call mutate,$(BUILD),$$(($(FUZZ_SECONDS) / 3))s)

# Under AddressSanitizer and UndefinedBehaviorSanitizer: FUZZ_COUNT mutations each.
fuzz-sanitized: packages
	cmake --preset sanitize
	$(call mutate,build-sanitize,$(FUZZ_COUNT))

faults: configure
	cmake --build $(BUILD) --target plant-faults
	$(BUILD)/tests/plant-faults tests/faults/faults.list . $(BUILD)-faults/source
	cmake -S $(BUILD)-faults/source -B $(BUILD)-faults -DCMAKE_BUILD_TYPE=Release -DMPM_NATIVE_KERNELS=OFF -DMPM_UNITY=OFF \
	  -DCMAKE_DISABLE_PRECOMPILE_HEADERS=ON
	cmake --build $(BUILD)-faults --target mpm-verify unit_tests
	sh tests/faults/run-faults $(BUILD)-faults $(RESULTS)-faults

package: program
	cmake --build $(BUILD) --target package

program: configure
	cmake --build $(BUILD) --target mpm-verify

packages:
	@sh .ci/install-packages

# Ninja where it is there; a build directory keeps the generator that it was made with.
configure: packages
	@if [ -f $(BUILD)/CMakeCache.txt ] || ! command -v ninja > /dev/null; then \
	  cmake -S . -B $(BUILD) -DCMAKE_BUILD_TYPE=Release; \
	else \
	  cmake -S . -B $(BUILD) -DCMAKE_BUILD_TYPE=Release -G Ninja; \
	fi

clean:
	rm -rf $(BUILD)
