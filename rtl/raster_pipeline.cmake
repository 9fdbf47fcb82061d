# The pipeline of all units, and its lint as each named configuration.
halfspace_rtl_unit(raster_pipeline)
