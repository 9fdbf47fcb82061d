raster_pkg.sv
credits.sv
credit_fifo.sv
pipe_register.sv
corner_test.sv
walk_edge.sv
walk_position.sv
tile_walker.sv
