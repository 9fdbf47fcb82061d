raster_pkg.sv
memory_fifo.sv
burst_fifo.sv
next_quads.sv
quad_generator.sv
