cycle_counters.sv
raster_pipeline.sv
