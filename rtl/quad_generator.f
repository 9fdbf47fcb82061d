raster_pkg.sv
memory_fifo.sv
credits.sv
burst_fifo.sv
next_quads.sv
quad_generator.sv
