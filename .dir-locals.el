;; SPDX-License-Identifier: BSD-3-Clause
;; Archives in any folder here complete and validate in nxml-mode. Emacs asks once whether it may.
((nxml-mode
  . ((eval . (let ((root (locate-dominating-file default-directory ".dir-locals.el")))
               (setq-local rng-schema-locating-files
                           (cons (expand-file-name "schemas.xml" root)
                                 rng-schema-locating-files))
               (rng-auto-set-schema))))))
