"""hairline: ray-triangle tests and their epsilons against exact predicates.

    >>> import hairline, numpy as np
    >>> hairline.audit(my_kernel, scene="room").summary()     # where is my function wrong?
    >>> hairline.assert_conforms(my_kernel)                   # the same as a test
    >>> hairline.truth(origin, direction, a, b, c)["hit"]     # what would be right?
    >>> hairline.Scene(vertices, faces).nearest(origin, direction)["face"]   # and of a whole mesh?

Triangles a, b, c run counter-clockwise seen from the front; u is the weight of b and v that of c; t is the ray's
parameter, in lengths of the direction. The command `hairline` comes with the package.
"""

from ._audit import Audit, advise, assert_conforms, audit
from ._kernel import KernelError, case
from ._picture import Picture
from ._scene import Judgement, Meeting, Scene, Where
from ._truth import Class, Facing, Feature, Place, truth

__all__ = [
    "Audit", "Class", "Facing", "Feature", "Judgement", "KernelError", "Meeting", "Picture", "Place", "Scene", "Where", "advise",
    "assert_conforms", "audit", "case", "truth",
]
