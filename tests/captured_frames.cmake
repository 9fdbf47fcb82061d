# Where captured frames that do not ship are looked for; tests that need them skip where it is absent.
set(HALFSPACE_FRAMES ${PROJECT_SOURCE_DIR}/../shared/frames CACHE PATH "Folder of captured frames, for tests")
