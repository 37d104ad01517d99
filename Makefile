# make demo: install packages/program.txt, build the program, fold the helmet rib.
# make test: build and run all tests.   make sanitize: the same under every sanitizer; make asan, make tsan: under one.
# make coverage: which lines and branches of the sources the tests run; build/coverage/index.html shows them.
# make faults: disks that fill, memory that runs out, signals, clocks that jump, at many more moments than the tests try.
# make mutants: 100 wrong signs and indices in the model and the physics, each of which a test must see.
# make python: the program, and the Python module in build/release/python (PYTHONPATH).
# make package: build/package/kinetix_*.deb, with the Python module.
# make bench: measure the figures of benchmarks/README.md; make bench-quick: what people wait for and the kernels, 5 minutes.
# make format: lay out every source as .clang-format says.
# make compilers: the same numbers by GCC and clang, -O0 and -O3, on a dozen targets.
# make fuzz: the readers under libFuzzer, FUZZ_SECONDS each; make fuzz-program: FUZZ_RUNS runs of the whole program.
# make soak: the long proofs that make test leaves out, and SOAK_FILES damaged files of every kind that is read, through
#   the program under the address sanitizer.
# make docs: write the pages of files in docs/reference and the schemas anew from the tables of keys, and outputs in pages from runs.
# make figures: draw all pictures of the documentation (CONTRIBUTING.md lists them). make gallery: of docs/gallery.md and README.md alone.
# make site: build/site, the documentation for a browser.
JOBS ?= $(shell nproc)
SUDO := $(shell [ "$$(id -u)" = 0 ] || echo sudo)
PROGRAM_PACKAGES := build/.installed/program
# Seconds of each fuzzer, and runs of the whole program.
FUZZ_SECONDS ?= 600
FUZZ_RUNS ?= 100000
# Damaged files of each kind.
SOAK_FILES ?= 1000
ALL_PACKAGES := $(patsubst packages/%.txt,build/.installed/%,$(wildcard packages/*.txt))

.PHONY: demo program python package install test faults dev asan tsan sanitize coverage compilers fuzz fuzz-program soak bench bench-quick format docs figures gallery site packages clean mutants

demo: program
	build/release/bin/kinetix-opt targets/shapes/helmet_rib.yaml -o results/helmet_rib

program: $(PROGRAM_PACKAGES)
	cmake --preset $@
	cmake --build --preset $@ -j $(JOBS)

python: $(PROGRAM_PACKAGES) build/.installed/python
	cmake --preset $@
	cmake --build --preset $@ -j $(JOBS)

package: site python build/.installed/package
	cpack --config build/release/CPackConfig.cmake -B build/package

install: program
	cmake --install build/release

test: dev
	ctest --preset dev

faults: dev
	tests/faults/faults.py build/dev/bin/kinetix-opt build/dev/tests/faults/long all --long

mutants: dev
	tests/mutation/mutate.py build/dev build/mutants

dev: $(ALL_PACKAGES)
	cmake --preset $@
	cmake --build --preset $@ -j $(JOBS)

docs: $(ALL_PACKAGES)
	cmake --preset dev
	cmake --build --preset dev -j $(JOBS) --target kinetix-formats
	cmake --build --preset dev -j $(JOBS) --target kinetix-opt
	build/dev/bin/kinetix-formats .
	tests/project/run_pages.py build/dev/bin/kinetix-opt . build/pages --write

gallery: program
	docs/gallery/draw.py build/release/bin/kinetix-opt build/gallery

# Without Blender the rendering of the rib stays as it is. Pictures of the studio need the packages of the page tests.
figures: dev gallery
	docs/figures/draw.py
	build/dev/bin/kinetix-opt targets/shapes/helmet_rib.yaml -o build/figures/helmet_rib
	build/dev/bin/kinetix-opt export build/figures/helmet_rib --format stl --state flat -o build/figures/flat
	build/dev/bin/kinetix-opt export build/figures/helmet_rib --format stl --state folded -o build/figures/folded
	/usr/bin/python3 docs/figures/render.py build/figures/flat/all.stl build/figures/folded/all.stl docs/figures/printed_rib.png
	build/dev/bin/kinetix-opt export build/figures/helmet_rib --format glb -o build/figures/glb
	if command -v blender > /dev/null; then blender -b --factory-startup --python docs/figures/render_rib.py -- \
	  build/figures/glb/helmet_rib.glb docs/figures/rib_rendering.jpg; fi
	KINETIX_OPT=$(CURDIR)/build/dev/bin/kinetix-opt node build/dev/tests/viewer/pictures.mjs docs/figures

site: build/.installed/site
	mkdocs build --quiet
	doxygen docs/site/Doxyfile

asan tsan: $(ALL_PACKAGES)
	cmake --preset $@
	cmake --build --preset $@ -j $(JOBS)
	ctest --preset $@

sanitize: asan tsan

coverage: $(ALL_PACKAGES)
	cmake --preset $@
	cmake --build --preset $@ -j $(JOBS)
	find build/$@ -name '*.gcda' -delete
	ctest --preset $@; \
	gcovr --root . --object-directory build/$@ --filter '(model|targets|optim|sim|app)/' --exclude-throw-branches \
	  --exclude-unreachable-branches --gcov-ignore-parse-errors --print-summary --txt build/$@/files.txt --html-details build/$@/index.html

compilers: $(ALL_PACKAGES)
	tests/tools/compilers.sh

fuzz: $(ALL_PACKAGES)
	cmake --preset $@
	cmake --build --preset $@ -j $(JOBS)
	tests/fuzz/fuzz.sh build/fuzz $(FUZZ_SECONDS)

fuzz-program: $(ALL_PACKAGES)
	cmake --preset dev
	cmake --build --preset dev -j $(JOBS) --target kinetix-forked-runs
	tests/fuzz/whole_program.py build/dev/bin/kinetix-forked-runs $(FUZZ_RUNS) --keep build/fuzz/found

soak: dev
	ctest --preset dev -C soak -L soak
	cmake --preset asan
	cmake --build --preset asan -j $(JOBS) --target kinetix-opt
	tests/fuzz/soak.py build/asan/bin/kinetix-opt $(SOAK_FILES) --jobs $(JOBS) --keep build/asan/soak

bench: $(ALL_PACKAGES)
	cmake --preset release
	cmake --build --preset $@ -j $(JOBS)
	build/release/bin/kinetix-bench --write benchmarks/README.md; figures=$$?; \
	build/release/bin/kinetix-hard-cases --write benchmarks/README.md && exit $$figures

bench-quick: $(ALL_PACKAGES)
	cmake --preset release
	cmake --build --preset bench -j $(JOBS)
	build/release/bin/kinetix-bench --quick

format: $(ALL_PACKAGES)
	git ls-files '*.cpp' '*.hpp' | xargs clang-format-14 -i

packages: $(ALL_PACKAGES)

build/.installed/%: packages/%.txt
	@mkdir -p $(@D)
	@missing=$$(grep -v '^#' $< | xargs -n 1 sh -c 'command -v "$$0" >/dev/null || dpkg -s "$$0" >/dev/null 2>&1 || echo "$$0"'); \
	if [ -n "$$missing" ]; then \
	  $(SUDO) apt-get update -qq && \
	  $(SUDO) env DEBIAN_FRONTEND=noninteractive apt-get install -y -qq --no-install-recommends $$missing; \
	fi
	@touch $@

clean:
	rm -rf build results
