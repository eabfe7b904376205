"""Intensity measures of a made record by eqsig 1.2.17 (PyPI), which crates/app/tests/app/suites.rs holds topple's to.

    pip install eqsig==1.2.17 && python crates/app/tests/data/measures.py > crates/app/tests/data/measures.csv

The record has 4,000 samples at 0.005 s: three sines that grow and decay. eqsig integrates by trapezia, topple takes the
record as linear between its samples.
"""

import eqsig
import numpy as np

dt, count = 0.005, 4000
t = dt * np.arange(count)
envelope = (t / 3.0) * np.exp(1.0 - t / 3.0)
a = envelope * (2.0 * np.sin(2.0 * np.pi * 0.8 * t) + 1.5 * np.sin(2.0 * np.pi * 2.3 * t + 1.0)
                + 0.7 * np.sin(2.0 * np.pi * 5.1 * t + 2.0))
record = eqsig.AccSignal(a, dt)
print("measure,value")
print(f"pga,{np.max(np.abs(a)):.10g}")
print(f"pgv,{record.pgv:.10g}")
arias = eqsig.im.calc_arias_intensity(record)[-1]
print(f"arias,{arias:.10g}")
print(f"cav,{eqsig.im.calc_cav(record)[-1]:.10g}")
for name, end in [("d5_75", 0.75), ("d5_95", 0.95)]:
    print(f"{name},{eqsig.im.calc_sig_dur(record, start=0.05, end=end):.10g}")
periods = np.array([0.1, 0.3, 1.0, 2.0, 4.0])
for period, value in zip(periods, eqsig.sdof.pseudo_response_spectra(a, dt, periods, 0.05)[2]):
    print(f"sa:{period},{value:.10g}")
