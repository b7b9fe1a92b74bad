"""The service's answers as dataclasses. Lengths are millimetres and angles degrees."""
