-- slides.lua - turns a course in Markdown into articles of a page or, with `-M deck`, into slides.
-- A heading of level 2 begins a slide; what follows " · " in it is the place in the notes. Below it stand
-- a picture, one statement whose links set the live picture, one equation in $$ $$, C lines with their
-- values, and questions in <details>; a link in a question is the picture it begins with. An ordered list
-- becomes boxes with arrows between them. A heading of level 1 names the part that slides belong to; after
-- <!-- build --> each word adds a term to the equation, which is as wide as the slide.
local deck, live, count, part = false, false, 0, ''
local course

local function html(text) return pandoc.RawBlock('html', text) end
local function escaped(text)
    return (text:gsub('&', '&amp;'):gsub('<', '&lt;'):gsub('"', '&quot;'))
end

-- ---- addresses of the playground: those of one slide share its first `with`

local PLAYGROUND = '^%.%./playground/index%.html#'
local function is_live(inline) return inline.t == 'Link' and inline.target:match(PLAYGROUND) end
local function hash_of(link) return (link.target:gsub(PLAYGROUND, '')) end
local function address(link, with)
    local hash = hash_of(link)
    return 'index.html#bare&letters=' .. course .. '&' .. (hash:match('turn=') and '' or 'turn=0&') ..
        (hash:match('with=') and '' or 'with=' .. with .. '&') .. hash
end

-- ---- formulas

-- Words for TeX: "N.L", "k_d"
local function spoken(inlines)
    return (pandoc.utils.stringify(pandoc.Plain(inlines)):gsub('\\mathbf{(.-)}', '%1'):gsub('\\cdot', '·')
        :gsub('\\,', ' '):gsub('[\\{}]', ''):gsub('^ +', ''))
end
-- MathML of pandoc, in which each term of k_e, k_a, k_d or k_s has the class of its colour, to the next sign,
-- comma or bracket; fences grow and bars are borders, as MathML Core wants it.
local FENCES = { ['+'] = true, ['='] = true, [','] = true, [']'] = true, ['}'] = true, ['&lt;'] = true }
local function term_end(text, at)
    local depth = 0
    while true do
        local from, to, close, name, empty = text:find('<(/?)(%a+)[^>]-(/?)>', at)
        if not from or (close == '/' and depth == 0) then return at end
        if depth == 0 and ((name == 'mo' and FENCES[text:match('^<mo[^>]*>(.-)</mo>', from)]) or
            text:match('^<mspace width="[12]', from)) then return at end
        if close == '/' then depth = depth - 1 elseif empty == '' then depth = depth + 1 end
        at = to + 1
    end
end
local function coloured(text)
    local out, at = '', 1
    while true do
        local from, _, letter = text:find('<msub><mi>k</mi><mi>([eads])</mi></msub>', at)
        if not from then return out .. text:sub(at) end
        local to = term_end(text, from)
        out = out .. text:sub(at, from - 1) .. '<mrow class="' .. letter .. '">' .. text:sub(from, to - 1) .. '</mrow>'
        at = to
    end
end
local function mathml(math)
    local text = pandoc.write(pandoc.Pandoc{ pandoc.Plain{ math } }, 'html',
        pandoc.WriterOptions{ html_math_method = 'mathml' })
    local body, note = text:match('^(.-)(<annotation.*)$')
    if not body then return nil end
    body = body:gsub('minsize="[%d.]+" maxsize="[%d.]+" stretchy="false"', 'minsize="2.4em" stretchy="true" symmetric="true"')
    -- What holds nothing tall does not stretch, nor does its partner: Latin Modern Math draws signs that may
    -- stretch too wide.
    local still, open = {}, {}
    for at, form in body:gmatch('()<mo stretchy="true" form="(%a+)">[()]</mo>') do
        if form == 'prefix' then open[#open + 1] = at
        elseif #open > 0 then
            local first = table.remove(open)
            local inner = body:sub(first, at)
            if not (inner:match('<mfrac') or inner:match('<munder') or inner:match('<mtable')) then
                still[#still + 1], still[#still + 2] = first, at
            end
        end
    end
    table.sort(still)
    for i = #still, 1, -1 do
        body = body:sub(1, still[i] - 1) .. body:sub(still[i]):gsub('"true"', '"false"', 1)
    end
    body = body:gsub('<mtable>', '<mtable displaystyle="true">')
    body = body:gsub('<mover>(.-)<mo accent="true">¯</mo></mover>', '<mrow class="over">%1</mrow>')
    if body:match('∝') then body = body:gsub('(</?)mtext', '%1mi') end          -- words beside a sign take its room
    body = body:gsub('<mo>∝</mo>', '<mo lspace="0.28em" rspace="0.28em">∝</mo>')
    return pandoc.RawInline('html', coloured(body) .. note)
end

-- ---- the parts of a slide

local function is_equation(block)
    return block.t == 'Para' and #block.content == 1 and block.content[1].t == 'Math' and
        block.content[1].mathtype == 'DisplayMath'
end
local function picture_of(block)
    return block.t == 'Para' and #block.content == 1 and block.content[1].t == 'Image' and block.content[1]
end
local function live_links(blocks)
    local links = pandoc.List()
    pandoc.walk_block(pandoc.Div(blocks), { Link = function(link)
        if is_live(link) then links:insert(link) end
    end })
    return links
end

-- C lines: code // = value
local function code_lines(text)
    local lines = pandoc.List()
    for line in text:gmatch('[^\n]+') do
        local code, value = line:match('^(.-) // = (.*)$')
        lines:insert(html('<pre><code>' .. escaped(code or line) .. '</code>' ..
            (value and ' <b>= ' .. value .. '</b>' or '') .. '</pre>'))
    end
    return lines
end

local function parts_of(blocks)
    local slide = { text = pandoc.List(), equations = pandoc.List(), code = pandoc.List(),
                    listings = pandoc.List(), questions = pandoc.List() }
    local asking
    for _, block in ipairs(blocks) do
        if block.t == 'RawBlock' then
            if block.text:match('^<details>') then
                asking = { question = pandoc.List(), answer = pandoc.List() }
                asking.to = asking.question
                slide.questions:insert(asking)
            elseif block.text:match('^</summary>') then asking.to = asking.answer
            elseif block.text:match('^</details>') then asking = nil
            elseif block.text:match('^<!%-%- build') then slide.build = true end
        elseif asking then asking.to:insert(block)
        elseif picture_of(block) then slide.picture = picture_of(block)
        elseif is_equation(block) then slide.equations:insert(block)
        elseif block.t == 'CodeBlock' and block.classes[1] == 'c' then
            slide.code:extend(code_lines(block.text))
        elseif block.t == 'CodeBlock' then slide.listings:insert(block)
        else slide.text:insert(block) end
    end
    slide.links, slide.asked = live_links(slide.text), pandoc.List()
    for _, ask in ipairs(slide.questions) do
        slide.asked:extend(live_links(ask.question))
        slide.asked:extend(live_links(ask.answer))
    end
    slide.with = slide.links[1] and slide.links[1].target:match('with=([^&]*)') or 'none'
    return slide
end

-- "Lambert's law · 10.1.1": what the slide is called, and its place in the notes
local function title_of(heading)
    local title, place = pandoc.List(), pandoc.List()
    local to = title
    for _, inline in ipairs(heading) do
        if inline.t == 'Str' and inline.text == '·' then to = place else to:insert(inline) end
    end
    while #title > 0 and title[#title].t == 'Space' do title:remove() end
    return title, place
end

local function file_of(image)
    return image.src:match('/') and (image.src:gsub('^%.%./%.%./', '')) or 'pictures/' .. image.src
end
-- Width by height of a PNG, as its header has them
local function aspect_of(path)
    local file = assert(io.open(path, 'rb'))
    local a, b, c, d, e, f, g, h = file:read(24):byte(17, 24)
    file:close()
    return (((a * 256 + b) * 256 + c) * 256 + d) / (((e * 256 + f) * 256 + g) * 256 + h)
end
local function alt_of(image) return escaped(pandoc.utils.stringify(image.caption)) end
-- Links to other rooms lead somewhere in the sources alone: in pages and slides they are words.
local function with_links(blocks, change)
    return pandoc.walk_block(pandoc.Div(blocks), { Link = function(link)
        if link.target:match('^%.%./%.%./') then return link.content end
        return change(link)
    end }).content
end

-- ---- a page

local function article(heading, slide)
    local out = pandoc.List{ html('<article id="' .. count .. '"><h2><a href="#' .. count .. '">'),
        pandoc.Plain(heading), html('</a></h2>') }
    local name = 'live-' .. count
    local function words(blocks)
        return with_links(blocks, function(link)
            if is_live(link) then
                return pandoc.Link(link.content, address(link, slide.with), '', { class = 'play', target = name })
            end
        end)
    end
    local first = live and (slide.links[1] or slide.asked[1])
    if first then
        out:insert(html('<div class="picture"><iframe name="' .. name .. '" loading="lazy" title="' ..
            escaped(spoken(heading)) .. '" src="' .. escaped(address(first, slide.with)) .. '"></iframe></div>'))
    elseif slide.picture then
        local file = file_of(slide.picture)
        out:insert(html('<a class="picture" href="' .. file .. '"><img src="' .. file .. '"' ..
            ' alt="' .. alt_of(slide.picture) .. '" loading="lazy"></a>'))
    end
    out:insert(html('<div class="words">'))
    out:extend(words(slide.text))
    out:extend(slide.listings)
    for _, equation in ipairs(slide.equations) do
        out:extend{ html('<div class="equation" tabindex="0">'), equation, html('</div>') }
    end
    out:extend(slide.code)
    for _, ask in ipairs(slide.questions) do
        out:insert(html('<details><summary>'))
        for _, block in ipairs(words(ask.question)) do out:insert(pandoc.Plain(block.content)) end
        out:insert(html('</summary>'))
        out:extend(words(ask.answer))
        out:insert(html('</details>'))
    end
    out:insert(html('</div></article>'))
    return out
end

-- ---- slides

-- The picture of a lesson. Its title may be "0-76: left | middle | right": the rows of it that are shown, in
-- percent, and captions in letters of the slide, in place of those that are drawn in it.
local function still(image)
    local img = '<img src="' .. file_of(image) .. '" alt="' .. alt_of(image) .. '"'
    local from, to, rest = image.title:gsub('^fig:', ''):match('^(%d+)%-(%d+):? ?(.*)$')
    if not from then return '<figure>' .. img .. '></figure>' end
    local shown, spans = (to - from) / 100, ''
    for caption in rest:gmatch('[^|]+') do spans = spans .. '<span>' .. escaped(caption:match('^ *(.-) *$')) .. '</span>' end
    return string.format('<figure class="shot" style="--aspect: %.4f"><div>%s style="margin-top: calc(%.4f * 100%%)"></div>' ..
        '<figcaption>%s</figcaption></figure>', aspect_of(image.src) / shown, img,
        -from / 100 / aspect_of(image.src), spans)
end
-- The place of the live picture, which one frame draws for all slides; or the picture of the lesson
local function figure(slide)
    local link = live and slide.links[1]
    if link then
        local last = slide.build and slide.links[#slide.links] or link
        return html('<figure class="live" data-first="' .. escaped(address(link, slide.with)) .. '" data-paper="' ..
            escaped(address(last, slide.with)) .. '"></figure>')
    end
    return slide.picture and html(still(slide.picture))
end
-- Words that move the live picture
local function moving(blocks, slide)
    local words = 0
    return with_links(blocks, function(link)
        if not is_live(link) then return nil end
        if not live then return link.content end
        words = words + 1
        local class = slide.build and words > 1 and 'play fragment' or 'play'
        return pandoc.Link(link.content, address(link, slide.with), '', { class = class })
    end)
end
local function flow(blocks)
    return blocks:map(function(block)
        return block.t == 'OrderedList' and pandoc.Div(block, { class = 'flow' }) or block
    end)
end
local function unlinked(blocks)
    return with_links(blocks, function(link) return is_live(link) and link.content or nil end)
end
-- What a slide has room for below an answer: its own listing, or else those of the answer.
local function listed(listing, blocks)
    local listings, rest = pandoc.List(), pandoc.List()
    if not listing then return listings, blocks end
    if select(2, listing.text:gsub('\n', '')) < 11 then return pandoc.List{ listing }, blocks end
    for _, block in ipairs(blocks) do
        local moves = block.t == 'CodeBlock' and not block.classes:includes('c')
        if moves then listings:insert(block) else rest:insert(block) end
    end
    return listings, rest
end
local function notes(slide)
    local out = pandoc.List{ html('<aside class="notes">') }
    for _, ask in ipairs(slide.questions) do
        out:extend(unlinked(ask.question))
        out:extend(unlinked(ask.answer))
    end
    -- the speaker's view has a style of its own
    for _, line in ipairs(slide.code) do
        out:insert(html((line.text:gsub('^<pre>', '<pre style="white-space: pre-wrap; overflow-wrap: anywhere">'))))
    end
    out:insert(html('</aside>'))
    return out
end
local function section(class, title, place, parts)
    local out = pandoc.List{ html('<section class="' .. class .. '" data-part="' .. escaped(part) ..
        '" data-place="' .. escaped(spoken(place)) .. '"><h2>'), pandoc.Plain(title), html('</h2>') }
    for _, part in ipairs(parts) do out:extend(part) end
    out:insert(html('</section>'))
    return out
end
local function layout(slide)
    local first = live and slide.links[1] and slide.links[1].target
    if slide.build then return 'build' end
    if first and (first:match('[#&]plane=1') or first:match('[#&]raster=1')) then return 'beside plane' end
    if first and not first:match('[#&]shape=3') and not first:match('[#&]compare=1') then return 'beside' end
    return (first or slide.picture) and 'below' or 'words'
end

local function sections(heading, slide)
    local title, place = title_of(heading)
    local parts = pandoc.List{ pandoc.List{ html('<div class="statement">') } }
    parts:extend{ flow(moving(slide.text, slide)), slide.listings, pandoc.List{ html('</div>') } }
    local shown = figure(slide)
    if shown then parts:insert(pandoc.List{ shown }) end
    if #slide.equations > 0 then
        parts:extend{ pandoc.List{ html('<div class="equation">') }, slide.equations,
            pandoc.List{ html('</div>') } }
    end
    parts:insert(notes(slide))
    local out = section(layout(slide), title, place, parts)
    for _, ask in ipairs(slide.questions) do
        local links = live_links(ask.answer)
        local first = live_links(ask.question)[1] or slide.links[1] or links[1]
        local asked = { picture = slide.picture, with = slide.with, links = pandoc.List{ first } }
        local answer = pandoc.List{ html('<div class="statement"><div class="fragment answer">') }
        local listing = slide.listings[1]
        local below, said = listed(listing, ask.answer)
        answer:extend(moving(said, asked))
        answer:insert(html('</div>'))
        local picture = not listing and figure(asked)
        local class = 'ask ' .. (picture and layout(asked) or 'words')
        local inlines = unlinked(ask.question)[1].content
        answer:extend(below)
        answer:insert(html('</div>'))
        out:extend(section(class, inlines, place,
            { answer, picture and pandoc.List{ picture } or pandoc.List(), notes(slide) }))
    end
    return out
end

-- A comma stays on the line of the formula before it, a bracket on that of the formula behind it.
local function is_formula(inline)
    if not inline then return false end
    if inline.t == 'Span' then return inline.classes:includes('glued') and is_formula(inline.content[#inline.content]) end
    if inline.t == 'Link' then return #inline.content == 1 and is_formula(inline.content[1]) end
    return inline.t == 'Math'
end
local function glued(inlines)
    local out = pandoc.List()
    for _, inline in ipairs(inlines) do
        local before = out[#out]
        if is_formula(before) and inline.t == 'Str' and inline.text:match('^[,.;:)?]') or
            is_formula(inline) and before and before.t == 'Str' and before.text:match('%($') then
            out[#out] = pandoc.Span({ before, inline }, { class = 'glued' })
        else out:insert(inline) end
    end
    return out
end

function Pandoc(doc)
    doc = pandoc.Pandoc(pandoc.walk_block(pandoc.Div(doc.blocks), { Inlines = glued }).content, doc.meta)
    deck, live = doc.meta.deck ~= nil, doc.meta.live ~= nil
    course = pandoc.utils.stringify(doc.meta.course)
    local out, about, heading, body = pandoc.List(), pandoc.List(), nil, pandoc.List()
    local contents = pandoc.List()
    local function finish()
        if not heading then (count > 0 and out or about):extend(body)
        else
            count = count + 1
            out:extend((deck and sections or article)(heading, parts_of(body)))
            contents:insert({ pandoc.Plain{ pandoc.Link(title_of(heading), '#' .. count) } })
        end
        body = pandoc.List()
    end
    for _, block in ipairs(doc.blocks) do
        if block.t == 'Header' and block.level == 2 then
            finish()
            heading = block.content
        elseif block.t == 'Header' and block.level == 1 then
            finish()
            heading, part = nil, spoken(block.content)
        else body:insert(block) end
    end
    finish()
    local function written(blocks) return pandoc.walk_block(pandoc.Div(blocks), { Math = mathml }).content end
    doc.meta.about = pandoc.MetaBlocks(written(about))
    doc.meta.slides = pandoc.MetaBlocks(written{ pandoc.OrderedList(contents) })
    doc.blocks = written(out)
    return doc
end
