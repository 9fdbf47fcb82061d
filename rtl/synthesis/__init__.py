"""What rtl/synth.py is made of."""
