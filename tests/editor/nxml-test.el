;; SPDX-License-Identifier: BSD-3-Clause
;; Archives in nxml-mode of Emacs, with the settings of the repository alone: they get the schema,
;; good ones have no error, broken ones have one, and names are completed.
;;   emacs -Q --batch -l tests/editor/nxml-test.el -- GOOD... --broken BROKEN...
(require 'nxml-mode)
(require 'rng-valid)
(require 'rng-nxml)

(setq enable-local-eval t
      ;; Leave nothing beside the files.
      create-lockfiles nil
      auto-save-default nil
      make-backup-files nil
      vc-handled-backends nil)

(defvar test-failures 0)
(defvar test-count 0)

(defun test-check (good format &rest arguments)
  (setq test-count (1+ test-count))
  (unless good
    (setq test-failures (1+ test-failures))
    (message "FAILED: %s" (apply #'format format arguments))))

(defun test-validate ()
  "Validate the whole buffer and return the number of errors."
  (rng-validate-mode 1)
  (while (rng-do-some-validation))
  rng-error-count)

(defmacro test-with-file (file &rest body)
  (declare (indent 1))
  `(let ((buffer (let ((inhibit-message t)
                       ;; In archives nobody is asked about .dir-locals.el; elsewhere as somebody
                       ;; who answered that it may.
                       (enable-local-variables
                        (if (string-match-p "\\(^\\|/\\)archives/" ,file) nil :all)))
                   (find-file-noselect ,file))))
     (unwind-protect (with-current-buffer buffer ,@body)
       (with-current-buffer buffer (set-buffer-modified-p nil))
       (kill-buffer buffer))))

(defun test-file (file broken)
  (test-with-file file
    (test-check (eq major-mode 'nxml-mode) "%s opens in %s" file major-mode)
    (test-check (and rng-current-schema-file-name
                     (string-suffix-p "terrane.rnc" rng-current-schema-file-name))
                "%s has the schema %s" file rng-current-schema-file-name)
    (let ((errors (test-validate)))
      (if broken
          (test-check (> errors 0) "%s is broken, and no error is seen" file)
        (test-check (= errors 0) "%s has %d errors" file errors)))))

(defun test-complete (file before typed expected)
  "Type TYPED behind the text BEFORE of FILE, complete it, and compare what stands there."
  (test-with-file file
    (test-validate)
    (goto-char (point-min))
    (search-forward before)
    (let ((start (point)))
      (insert typed)
      (completion-at-point)
      (test-check (string= (buffer-substring start (point)) expected)
                  "'%s' becomes '%s', not '%s'" typed
                  (buffer-substring start (point)) expected))))

(defvar test-arguments (delete "--" command-line-args-left))
(setq command-line-args-left nil)
(let ((broken nil))
  (dolist (argument test-arguments)
    (if (string= argument "--broken") (setq broken t)
      (test-file argument broken))))

(let ((file "archives/mountains/archive.xml"))
  (test-complete file "<terrainNode" " horizonC" " horizonCulling=\"")
  (test-complete file "<archive>" "<multi" "<multithreadScheduler")
  (test-complete file "<gpuTileStorage" " maxA" " maxAniso=\"")
  (test-complete file "<terrainNode" " horizonCulling=\"fa" " horizonCulling=\"false\""))

(message "%d checks, %d failed" test-count test-failures)
(kill-emacs (if (= test-failures 0) 0 1))
