"""Figures; they need matplotlib, the extra "scripts"."""
