# The two commands: `make demo` and `make test`. Everything else is for those who work on halfspace. CI runs `make test test-sanitized lint`.

BUILD := build/release
HALFSPACE := $(BUILD)/bin/halfspace
PYTHON_TOOLS := .venv/.installed
PLOT_TOOLS := .venv/.plot_installed
PROVE_TOOLS := .venv/.prove_installed
READ_TOOLS := .venv/.read_installed
GALLERY_TOOLS := .venv/.gallery_installed

.DEFAULT_GOAL := help

.PHONY: help
help: ## Show this list.
	@grep -hE '^[a-z-]+:.*## ' $(MAKEFILE_LIST) | sed -E 's/:.*## /\t/' | expand -t 12

.PHONY: demo
demo: release-program ## Install what is missing, build, and rasterize a truck of 117,013 triangles into out/cc0_truck.
	$(HALFSPACE) run scenes/cc0_truck.ptf.xz --fidelity recurrence --out out/cc0_truck

.PHONY: test
test: release ## Install what is missing, build, and run the tests.
	ctest --test-dir $(BUILD) -LE 'slow|lint|synthesis|formal' --output-on-failure -j 2

.PHONY: test-sanitized
test-sanitized: debug ## Run the tests of the library once more with AddressSanitizer and UndefinedBehaviorSanitizer.
	ctest --test-dir build/debug -L 'unit|property|timing' --output-on-failure -j 2

.PHONY: lint
lint: build/release/build.ninja $(PYTHON_TOOLS) $(PROVE_TOOLS) $(GALLERY_TOOLS) ## Look at layout and static analysis, synthesize the RTL, and prove it in part.
	ctest --test-dir $(BUILD) -L 'lint|synthesis|formal' --output-on-failure -j 2

.PHONY: test-slow
test-slow: release debug $(PYTHON_TOOLS) ## Build and run the long campaigns, and what `make test` leaves to them.
	@sh tools/install_packages.sh tools/packages-slow.txt
	cmake --build --preset release --target slow_benches
	cmake --build --preset debug --target halfspace_system_tests
	ctest --test-dir build/debug -L slow --output-on-failure -j 2
	ctest --test-dir $(BUILD) -L slow --output-on-failure -j 2

.PHONY: prove
prove: $(PROVE_TOOLS) ## Install what is missing, and prove the arithmetic and the RTL: proofs/coq, proofs/gappa, proofs/smt.
	@sh tools/install_packages.sh tools/packages-prove.txt
	rm -rf build/proofs
	proofs/coq/check.py build/proofs/coq
	proofs/gappa/check.sh build/proofs/gappa
	.venv/bin/python proofs/smt/check.py build/proofs/smt

.PHONY: rtl
rtl: build/release/build.ninja ## Verilate the pipeline of every named configuration, for --fidelity rtl.
	@sh tools/install_packages.sh tools/packages-rtl.txt
	cmake --preset release --log-level=WARNING
	cmake --build --preset release --target halfspace_cli raster_pipeline_fast

.PHONY: bench
bench: release-program ## Measure the functional model on the shipped frames; bench-speed measures more.
	$(HALFSPACE) bench speed scenes/*.ptf.xz

# Captured frames that do not ship, where the tests look for them.
SCENES := $(wildcard scenes/*.ptf.xz)
FRAMES = $(or $(HALFSPACE_FRAMES),$(shell sed -n 's/^HALFSPACE_FRAMES:PATH=//p' $(BUILD)/CMakeCache.txt))
CAPTURED = $(filter-out $(addprefix %/,$(notdir $(SCENES))),$(wildcard $(FRAMES)/*.ptf.xz))

RESTING = baseline small wide shallow slow_memory
.PHONY: bench-idle
bench-idle: build/release/build.ninja ## Measure cycles that SystemC and the RTL leave out; write docs/guides/time.md's table.
	cmake --build --preset release --target halfspace_cli $(addprefix halfspace_rtl_,$(RESTING))
	tools/write_figures.py bench-idle --captured $(filter %/openarena_gl2.ptf.xz,$(CAPTURED))

.PHONY: idle-toggles
idle-toggles: build/release/build.ninja ## Count what toggles in units of the RTL that do nothing, with fst2vcd (Debian: gtkwave); write docs/guides/time.md's table.
	cmake --build --preset release --target halfspace_cli halfspace_rtl_small_no_dfg
	tools/write_figures.py idle-toggles

.PHONY: bench-error
bench-error: build/release/build.ninja $(PLOT_TOOLS) ## Measure every fidelity beside the RTL; write docs/guides/error.md's tables and picture.
	cmake --build --preset release --target halfspace_cli halfspace_rtl_baseline
	$(HALFSPACE) bench error --config configs/baseline.toml $(SCENES) $(CAPTURED) --synthetic --out out/error
	.venv/bin/python tools/plot_error.py out/error/error.json docs/images/error.png
	tools/write_figures.py bench-error --captured $(CAPTURED)

# What `halfspace bench speed` says of the ten full lists, to show and to remember.
.PHONY: speed
speed: release-program
	@mkdir -p out/speed
	$(HALFSPACE) bench speed --json out/speed/speed.json --csv out/speed/speed.csv > out/speed/speed.md

.PHONY: bench-speed
bench-speed: speed $(PLOT_TOOLS) ## Measure the model beside a scalar loop and llvmpipe; write docs/guides/speed.md's table and picture.
	.venv/bin/python tools/plot_speed.py out/speed/speed.json docs/images/speed.svg
	tools/write_figures.py bench-speed

.PHONY: bench-literature
bench-literature: release-program ## Measure what published mechanisms save on our frames; write docs/guides/literature.md's tables.
	tools/write_literature.py --captured $(CAPTURED)

.PHONY: study-orientation study-depth-resolution
study-orientation study-depth-resolution: build/release/build.ninja ## Run a test that others published; write docs/guides/robustness.md's tables.
	cmake --build --preset release --target halfspace_$(subst -,_,$@)
	tools/write_robustness.py $(@:study-%=%)

.PHONY: study-interpolation
study-interpolation: release-program ## Draw a floor by each interpolation, and measure the interpolator's error by its precision; write docs/guides/shading.md's pictures and table.
	cmake --build --preset release --target halfspace_study_interpolation
	tools/write_shading.py

.PHONY: stress-reports
stress-reports: release-program ## Draw the scenes of public reports with rasterizers that fail; write docs/guides/stress.md's table.
	tools/write_robustness.py stress-reports

.PHONY: bench-profile
bench-profile: build/release/build.ninja ## Sample where the fast core spends its time, with perf; write docs/guides/speed.md's table.
	cmake --preset profile --log-level=WARNING
	cmake --build --preset profile
	@mkdir -p out/speed
	tools/profile_speed.py build/profile/bin/halfspace scenes/cc0_truck.ptf.xz $(CAPTURED) > out/speed/profile.md
	tools/write_figures.py bench-profile --captured $(CAPTURED)

.PHONY: bench-read
bench-read: release-program $(READ_TOOLS) ## Measure the readers of meshes beside assimp (Debian: assimp-utils), trimesh and pyminiply; write docs/guides/meshes.md's table.
	@mkdir -p out/read
	.venv/bin/python tools/bench_read.py $(HALFSPACE) > out/read/read.md
	tools/write_figures.py bench-read

.PHONY: bench-history
bench-history: speed $(PLOT_TOOLS) ## Measure the same, and append it to docs/speed_history.csv and its picture.
	tools/bench_history.py out/speed/speed.json docs/speed_history.csv
	.venv/bin/python tools/plot_speed.py docs/speed_history.csv docs/images/speed_history.svg

.PHONY: depth-error
depth-error: build/release/build.ninja ## Measure the largest error of depth over 10^8 samples; write docs/numerics.md's table.
	cmake --build --preset release --target halfspace_depth_error
	tools/write_figures.py depth-error

.PHONY: study-precision
study-precision: build/release/build.ninja $(PLOT_TOOLS) ## Measure the arithmetics of edges and depth; write docs/guides/precision.md's tables and pictures.
	cmake --build --preset release --target halfspace_study_precision
	@mkdir -p out/precision
	$(BUILD)/model/halfspace/study/precision/halfspace_study_precision --json out/precision/precision.json $(SCENES) $(CAPTURED)
	tools/write_precision.py --captured $(CAPTURED)
	set -e; for kind in edges depth; do \
	  .venv/bin/python tools/plot_precision.py out/precision/precision.json docs/precision.json $$kind docs/images/precision_$$kind.png; \
	done

.PHONY: study-traversal
study-traversal: release-program $(PLOT_TOOLS) ## Run every walk of block_walker on every frame; write docs/guides/traversal.md's tables and picture.
	tools/write_traversal.py --captured $(CAPTURED)
	.venv/bin/python tools/plot_traversal.py out/traversal/traversal.json docs/images/traversal.png

.PHONY: study-samples
study-samples: release-program $(PLOT_TOOLS) ## Compare pictures of few samples a pixel with one of very many; write docs/guides/multisampling.md's tables and picture.
	.venv/bin/python tools/write_samples.py --captured $(CAPTURED)
	.venv/bin/python tools/plot_samples.py out/samples/samples.json docs/images/samples.png

.PHONY: gallery
gallery: release-program $(GALLERY_TOOLS) ## Run every method and draw it; write docs/guides/gallery.md, its pictures and out/gallery/index.html.
	.venv/bin/python tools/gallery/build.py
	tools/gallery/check.py --html out/gallery/index.html

.PHONY: study-precision-gates
study-precision-gates: $(PYTHON_TOOLS) ## Synthesize these arithmetics, as far as docs/precision.json has no figures of them; takes half an hour in all.
	.venv/bin/python rtl/synth_study.py --json docs/precision.json

.PHONY: release debug
release debug: %: build/%/build.ninja
	cmake --build --preset $@

.PHONY: release-program
release-program: build/release/build.ninja
	cmake --build --preset release --target halfspace_cli

build/%/build.ninja: CMakePresets.json | packages
	cmake --preset $* --log-level=WARNING
	@touch $@

.PHONY: packages
packages:
	@sh tools/install_packages.sh

$(PYTHON_TOOLS): tools/requirements.txt | packages
	/usr/bin/python3 -m venv .venv
	.venv/bin/pip install --quiet --requirement $<
	touch $@

$(PLOT_TOOLS): tools/requirements-plot.txt | packages
	/usr/bin/python3 -m venv .venv
	.venv/bin/pip install --quiet --requirement $<
	touch $@

$(READ_TOOLS): tools/requirements-read.txt | packages
	/usr/bin/python3 -m venv .venv
	.venv/bin/pip install --quiet --requirement $<
	touch $@

$(GALLERY_TOOLS): tools/requirements-gallery.txt | packages
	/usr/bin/python3 -m venv .venv
	.venv/bin/pip install --quiet --only-binary :all: --requirement $<
	touch $@

# The solvers, beside Yosys of $(PYTHON_TOOLS).
$(PROVE_TOOLS): tools/requirements-prove.txt $(PYTHON_TOOLS)
	.venv/bin/pip install --quiet --requirement $<
	touch $@

# Nothing is replaced by a file that could not be printed whole, or that would be the same.
.PHONY: generated
generated: release-program ## Print anew what the C++ tables make: docs/config.md, configs/, rtl/raster_pkg.sv.
	cmake --build --preset release --target raster_pkg
	@mkdir -p $(BUILD)/generated
	$(HALFSPACE) config --markdown > $(BUILD)/generated/config.md
	cmake -E copy_if_different $(BUILD)/generated/config.md docs/config.md
	set -e; for machine in $(notdir $(wildcard configs/*.toml)); do \
	  $(HALFSPACE) config --toml --config configs/$$machine > $(BUILD)/generated/$$machine; \
	  cmake -E copy_if_different $(BUILD)/generated/$$machine configs/$$machine; \
	done

.PHONY: format
format: ## Lay out the sources by clang-format.
	git ls-files '*.cpp' '*.hpp' | xargs clang-format -i

.PHONY: clean
clean: ## Remove everything that was built.
	rm -rf build out .venv

# Each figure alone by its name, as `make bench-frames`: see tools/write_figures.py.
FIGURES := demo-figure bench-frames bench-roof bench-stages bench-surfaces bench-time bench-sampled \
           depth-traffic hi-z-kills hi-z-by-time hi-z-machines late-z small-triangles quad-merging reference-figure \
           what-if what-if-demo what-if-lod ledger-demo ledger-frames stress-sharpness
.PHONY: docs-figures ledger-picture $(FIGURES)
docs-figures: build/release/build.ninja ## Run the commands whose output the pages show; write it into them.
	cmake --build --preset release --target halfspace_cli halfspace_reference_tool
	tools/write_figures.py --captured $(CAPTURED)
ledger-picture: build/release/build.ninja ## Draw docs/images/ledger.svg.
	cmake --build --preset release --target halfspace_cli
	build/release/bin/halfspace ledger scenes/cc0_truck.ptf.xz --set hi_z.enabled=true \
	  --set z_cache.compression=true --savings --no-draws --out out/ledger
	cp out/ledger/ledger.svg docs/images/ledger.svg
$(FIGURES): build/release/build.ninja
	cmake --build --preset release --target halfspace_cli halfspace_reference_tool
	tools/write_figures.py $(@:-figure=) --captured $(CAPTURED)
