"""Six legs or nine on the same plates: the reference of the paper's closing remark.

The six-legged platform has legs r_i-u_i and r^_i-u~_i and no point O; its 6 x 6 matrix is made of the same leg rows.
"""

import ninedof as nd

LIMITS = {"radius_ratio": (None, 2.0)}
nine = nd.Study(constraints=LIMITS)
six = nd.Study(constraints=LIMITS, objective={"index": "six_legged"})

print(f"{'plates best for':18}{'nine legs':>12}{'six legs':>12}")
for name, study in (("nine legs", nine), ("six legs", six)):
    best = nd.optimize(study).variables
    plates = {n: x for n, x in best.items() if n != "zs"}
    # Six legs do not care where O is: put it where it serves the nine best.
    with_o = nd.optimize(nd.Study(variables=plates, constraints=LIMITS))
    print(f"{name:18}{with_o.objective:12.6f}{six.evaluate(best).objective:12.6f}")
