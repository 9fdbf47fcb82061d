raster_pkg.sv
credit_fifo.sv
pipe_register.sv
edge_saturate.sv
edge_steps.sv
edge_signs.sv
half_plane.sv
edge_evaluator.sv
